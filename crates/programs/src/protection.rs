//! Comments by which a program says what is not to be changed.

/// `(traverse: keep)`, `(traverse: off)`, `(traverse: on)`, in capitals or not, also behind `;`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Protection {
    /// This block stays as it is.
    Keep,
    /// From this block on, blocks stay as they are.
    Off,
    /// Up to here.
    On,
}

impl Protection {
    pub(crate) fn read(comment: &[u8]) -> Option<Self> {
        let text = str::from_utf8(comment).ok()?;
        let (name, command) = text.split_once(':')?;
        if !name.trim().eq_ignore_ascii_case("traverse") {
            return None;
        }
        let known = [("keep", Self::Keep), ("off", Self::Off), ("on", Self::On)];
        known.into_iter().find(|(word, _)| command.trim().eq_ignore_ascii_case(word)).map(|(_, known)| known)
    }
}
