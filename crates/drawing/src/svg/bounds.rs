//! Bounds that an XML text must keep so that parsing it takes no more than linear work and memory.

use crate::{ReadError, ReadOptions};
use std::collections::HashSet;

/// Most attributes of one element: the XML parser compares each with all before it.
const MOST_ATTRIBUTES: usize = 256;

/// Most different namespace prefixes: the XML parser copies those in force to each element that declares one.
const MOST_PREFIXES: usize = 64;

/// Most declared entities.
const MOST_ENTITIES: usize = 1000;

/// References per reference that the XML parser follows before it calls it a loop.
const MOST_NESTED_REFERENCES: u64 = 256;

/// Refuses a text that would take more to parse than its length lets one expect.
pub(super) fn check_bounds(text: &str, options: &ReadOptions) -> Result<(), ReadError> {
    check_entities(text, options)?;
    let mut prefixes = HashSet::new();
    let mut at = 0;
    // No `<` stands within a tag: what lies between two of them holds one tag at most.
    for piece in text.split('<') {
        let refused = |message: &str| {
            let line = 1 + text.as_bytes()[..at.min(text.len())].iter().filter(|&&b| b == b'\n').count();
            Err(ReadError::Malformed { line, message: message.to_owned() })
        };
        if attribute_count(piece) > MOST_ATTRIBUTES {
            return refused("an element has more than 256 attributes");
        }
        for declaration in piece.match_indices("xmlns:").map(|(at, mark)| &piece[at + mark.len()..]) {
            let end = declaration.find(|c: char| c == '=' || c.is_whitespace()).unwrap_or(declaration.len());
            prefixes.insert(&declaration[..end]);
            if prefixes.len() > MOST_PREFIXES {
                return refused("there are more than 64 namespace prefixes");
            }
        }
        at += piece.len() + 1;
    }
    Ok(())
}

/// Equals signs in a tag outside quotes.
fn attribute_count(piece: &str) -> usize {
    let mut count = 0;
    let mut quote = None;
    for byte in piece.bytes() {
        match (quote, byte) {
            (None, b'>') => break,
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'=') => count += 1,
            (Some(open), _) if open == byte => quote = None,
            _ => {}
        }
    }
    count
}

/// Bounds the length of the text with all entities written out.
fn check_entities(text: &str, options: &ReadOptions) -> Result<(), ReadError> {
    let mut longest = 0;
    let mut nested = false;
    for (count, (at, mark)) in text.match_indices("<!ENTITY").enumerate() {
        let rest = &text[at + mark.len()..];
        let value = rest.find(['"', '\'']).map_or("", |open| {
            let quote = rest.as_bytes()[open] as char;
            let value = &rest[open + 1..];
            &value[..value.find(quote).unwrap_or(value.len())]
        });
        longest = longest.max(value.len() as u64);
        nested |= value.contains('&');
        if count >= MOST_ENTITIES {
            return Err(ReadError::TooMuchRepeated { limit: options.byte_limit });
        }
    }
    if longest == 0 {
        return Ok(());
    }
    let references = text.bytes().filter(|&b| b == b'&').count() as u64;
    let each = longest.saturating_mul(if nested { MOST_NESTED_REFERENCES } else { 1 });
    if references.saturating_mul(each) > options.byte_limit {
        return Err(ReadError::TooMuchRepeated { limit: options.byte_limit });
    }
    Ok(())
}
