//! A first look over the whole program: what has to be known before its first line is acted on.

use crate::block::{Block, Kind};
use crate::codes::Code;
use crate::line::lines;
use traverse_drawing::GcodeUnit as Unit;

/// Decimal places are counted up to here; more are not written.
const MOST_PLACES: u8 = 6;

/// What a program as a whole tells.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Survey {
    /// Places behind the point that its positions have at most, in millimetres and in inches.
    pub(crate) places: [u8; 2],
    /// It numbers programs as Fanuc does.
    pub(crate) numbers_programs: bool,
    /// It holds `$` commands, which only Grbl knows.
    pub(crate) commands_grbl: bool,
    /// Whole numbers end in a point: `X10.`
    pub(crate) keeps_point: bool,
    /// It writes G00 rather than G0.
    pub(crate) two_digits: bool,
    /// A GOTO may come to any numbered block.
    pub(crate) jumps: bool,
    /// It changes its unit.
    pub(crate) mixes_units: bool,
    /// It changes its work offset.
    pub(crate) mixes_offsets: bool,
    /// It begins with `%`, so that a second `%` ends it.
    pub(crate) has_tape_mark: bool,
    /// Lines that hold words and were understood, and those that were not.
    pub(crate) understood: u64,
    pub(crate) faults: u64,
    /// Lines that decide which lines run.
    pub(crate) controls: u64,
}

impl Survey {
    /// Cost: linear.
    pub(crate) fn of(bytes: &[u8]) -> Self {
        let mut survey = Self::default();
        let mut block = Block::default();
        let (mut unit, mut offset) = (None, None);
        let mut anything = false;
        for line in lines(bytes) {
            let text = &bytes[line.start..line.end];
            block.read(text);
            match block.kind {
                Kind::TapeMark => survey.has_tape_mark |= !anything,
                Kind::ProgramNumber => survey.numbers_programs = true,
                Kind::Control => {
                    survey.controls += 1;
                    survey.jumps |= holds_goto(text);
                    survey.commands_grbl |= text.starts_with(b"$");
                }
                Kind::Fault(_) => survey.faults += 1,
                Kind::Words | Kind::Assignment { .. } => {}
            }
            anything |= !text.is_empty();
            survey.understood += u64::from(!block.words.is_empty() && !matches!(block.kind, Kind::Fault(_)));
            for word in &block.words {
                let Some(number) = word.decimal() else { continue };
                if word.letter == b'G' {
                    survey.two_digits |= matches!(&text[word.number..word.span.end], [b'0', b'0'..=b'3']);
                    match number.count(1).and_then(|tenths| u32::try_from(tenths).ok()).map(Code::of) {
                        Some(Code::Unit(next)) => {
                            survey.mixes_units |= unit.is_some_and(|unit| unit != next);
                            unit = Some(next);
                        }
                        Some(Code::Offset(next)) => {
                            survey.mixes_offsets |= offset.is_some_and(|offset| offset != next);
                            offset = Some(next);
                        }
                        _ => {}
                    }
                } else if matches!(word.letter, b'X' | b'Y' | b'Z') {
                    let places = &mut survey.places[usize::from(unit == Some(Unit::Inches))];
                    *places = number.places.clamp(*places, MOST_PLACES.max(*places));
                    survey.keeps_point |= number.has_point && number.places == 0;
                }
            }
        }
        survey
    }
}

fn holds_goto(text: &[u8]) -> bool {
    text.windows(4).any(|four| four.eq_ignore_ascii_case(b"GOTO"))
}
