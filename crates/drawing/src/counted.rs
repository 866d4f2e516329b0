//! A count with its noun, as people say it.

/// `1 loop`, `2 loops`. The noun is one whose plural ends in s.
pub(crate) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
