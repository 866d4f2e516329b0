//! A way as edits of the program: inserted blocks before the link's last block, and what is taken out of the others.

use crate::codes::{Distance, Motion};
use crate::edit::Edit;
use crate::link::{Heights, Link, RapidBlock};
use crate::modal::Feed;
use crate::program::Program;
use crate::reason::Reason;
use crate::rounded::{Move, Rounded};
use crate::spelling::Spelling;
use traverse_drawing::{ArcMotion, StraightMotion};

/// How moves are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Motions {
    pub(crate) straight: StraightMotion,
    pub(crate) arcs: ArcMotion,
}

/// The edits that make the program run `rounded` in the place of `link`.
pub(crate) fn edits(
    program: &Program<'_>,
    link: &Link,
    rounded: &Rounded,
    spelling: &Spelling,
    motions: Motions,
) -> Result<Vec<Edit>, Reason> {
    let Some((last, earlier)) = link.blocks.split_last() else { return Ok(Vec::new()) };
    let mut edits = Vec::new();
    let mut inserted = Vec::new();
    let mut writer = Writer { link, last, spelling, motions, motion: None, fed: false, turned: false };
    if let Heights::Sloped { from, to } = link.heights
        && to > from
        && let Some(z) = last.words[2]
    {
        let z = String::from_utf8_lossy(&program.bytes[z.number as usize..z.end as usize]);
        writer.motion = Some(0);
        spelling.line(&[spelling.code(0), format!("Z{}", z.trim())], &mut inserted);
    }
    for each in &rounded.moves {
        writer.block(each, &mut inserted)?;
    }
    writer.restore(program.bytes, &mut inserted)?;
    // What is inserted names its motion too, and leaves G0 in force.
    let motion_is_named = last.names_motion || !inserted.is_empty();
    for block in earlier {
        edits.push(without_words(program.bytes, block, motion_is_named));
    }
    if !inserted.is_empty() {
        let start = last.start as usize;
        edits.push(Edit { range: start..start, text: inserted });
    }
    if last.distance == Distance::Incremental {
        // The inserted blocks have come the whole way; the numbers of the last one become 0.
        let mut words: Vec<_> = last.words[..2].iter().flatten().collect();
        words.sort_by_key(|word| word.number);
        let zero = |word: &&crate::link::WordPlace| Edit {
            range: word.number as usize..word.end as usize,
            text: spelling.number(0).into_bytes(),
        };
        edits.extend(words.iter().map(zero));
    }
    Ok(edits)
}

/// Whether the link's last block runs the last straight move by itself: it names both axes, absolutely, and neither
/// sinks nor is to be fed.
pub(crate) fn leaves_last(link: &Link, straight: StraightMotion) -> bool {
    link.blocks.last().is_some_and(|last| {
        last.distance == Distance::Absolute && last.words[0].is_some() && last.words[1].is_some()
    }) && straight == StraightMotion::Rapid
        && !matches!(link.heights, Heights::Sloped { from, to } if to < from)
}

/// The block without its X and Y words and the blanks before them; nothing when nothing else stands on its line, or
/// nothing but a G0 that is said again behind it.
fn without_words(bytes: &[u8], block: &RapidBlock, motion_is_named: bool) -> Edit {
    let (start, end, next) = (block.start as usize, block.end as usize, block.next as usize);
    let mut kept = Vec::with_capacity(end - start);
    let mut at = start;
    let mut words: Vec<_> = block.words[..2].iter().flatten().collect();
    words.sort_by_key(|word| word.letter);
    for word in words {
        kept.extend_from_slice(&bytes[at..word.letter as usize]);
        while matches!(kept.last(), Some(b' ' | b'\t')) {
            kept.pop();
        }
        at = word.end as usize;
    }
    kept.extend_from_slice(&bytes[at..end]);
    let blank = |byte: &u8| matches!(byte, b' ' | b'\t');
    let is_motion = || match kept.trim_ascii() {
        [b'G' | b'g', number @ ..] => number.iter().all(|byte| *byte == b'0' || blank(byte)),
        _ => false,
    };
    if kept.iter().all(blank) || (motion_is_named && is_motion()) {
        return Edit { range: start..next, text: Vec::new() };
    }
    Edit { range: start..end, text: kept }
}

struct Writer<'a> {
    link: &'a Link,
    last: &'a RapidBlock,
    spelling: &'a Spelling,
    motions: Motions,
    /// The motion that the last inserted block has left in force.
    motion: Option<u8>,
    fed: bool,
    turned: bool,
}

impl Writer<'_> {
    fn block(&mut self, each: &Move, into: &mut Vec<u8>) -> Result<(), Reason> {
        let before = &self.link.before;
        let unit = before.unit.ok_or_else(not_known)?.millimetres();
        let end = match before.distance.ok_or_else(not_known)? {
            Distance::Absolute => each.end,
            Distance::Incremental => each.end.less(each.from),
        };
        let (code, feed) = match (each.arc, self.motions.straight, self.motions.arcs) {
            (Some(turn), _, ArcMotion::Fed { feed_mm_per_min }) => {
                (if turn.clockwise { 2 } else { 3 }, Some(feed_mm_per_min))
            }
            (_, StraightMotion::Fed { feed_mm_per_min }, _) => (1, Some(feed_mm_per_min)),
            _ => (0, None),
        };
        let mut words = Vec::new();
        if each.arc.is_some() && before.plane != Some(17) && !self.turned {
            words.push(self.spelling.code(17));
            self.turned = true;
        }
        words.push(self.spelling.code(code));
        words.extend(self.spelling.position(end, each));
        if let Some(feed) = feed {
            words.push(format!("F{}", self.spelling.feed(feed / unit)));
            self.fed = true;
        }
        self.motion = Some(code);
        self.spelling.line(&words, into);
        Ok(())
    }

    /// Puts back what the program relies on: motion mode, F, plane.
    fn restore(&self, bytes: &[u8], into: &mut Vec<u8>) -> Result<(), Reason> {
        let before = &self.link.before;
        let mut words = Vec::new();
        if self.turned {
            words.push(self.spelling.code(before.plane.ok_or_else(not_known)?));
        }
        if self.motion.is_some_and(|motion| motion != 0) && !self.last.names_motion {
            debug_assert_eq!(
                before.motion,
                Some(Motion::Rapid),
                "a block that names no motion moves rapidly"
            );
            words.push(self.spelling.code(0));
        }
        if self.fed && !self.last.sets_feed {
            match before.feed {
                Feed::Unset => {}
                Feed::Stands { start, end, .. } => {
                    let text = String::from_utf8_lossy(&bytes[start as usize..end as usize]);
                    words.push(format!("F{}", text.trim()));
                }
                Feed::Unknown => return Err(not_known()),
            }
        }
        if !words.is_empty() {
            self.spelling.line(&words, into);
        }
        Ok(())
    }
}

fn not_known() -> Reason {
    Reason::Refused("what is in force before it is not known".to_owned())
}
