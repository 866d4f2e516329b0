//! Changes of a text by place: everything between them stays as it is, byte for byte.

use std::ops::Range;

/// What stands in the place of a piece of text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Edit {
    pub(crate) range: Range<usize>,
    pub(crate) text: Vec<u8>,
}

/// The text with `edits` made; they are in order and do not overlap. Cost: linear.
pub(crate) fn apply(bytes: &[u8], edits: &[Edit]) -> Vec<u8> {
    debug_assert!(
        edits.windows(2).all(|pair| pair[0].range.end <= pair[1].range.start),
        "edits are in order"
    );
    let grown: usize = edits.iter().map(|edit| edit.text.len()).sum();
    let mut text = Vec::with_capacity(bytes.len() + grown);
    let mut at = 0;
    for edit in edits {
        text.extend_from_slice(&bytes[at..edit.range.start]);
        text.extend_from_slice(&edit.text);
        at = edit.range.end;
    }
    text.extend_from_slice(&bytes[at..]);
    text
}
