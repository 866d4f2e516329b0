//! How a program spells its blocks, so that what is added looks like the rest.

use crate::grid::Counts;
use crate::link::RapidBlock;
use crate::rounded::Move;
use crate::survey::Survey;
use traverse_drawing::GcodeDialect;

/// How a program spells its blocks.
#[derive(Clone, Debug)]
pub(crate) struct Spelling {
    spaced: bool,
    lower: bool,
    two_digits: bool,
    keeps_point: bool,
    places: u8,
    ending: Vec<u8>,
}

impl Spelling {
    /// As the block is spelled, with so many decimal places.
    pub(crate) fn of(
        bytes: &[u8],
        block: &RapidBlock,
        survey: &Survey,
        dialect: GcodeDialect,
        places: u8,
    ) -> Self {
        let line = &bytes[block.start as usize..block.end as usize];
        let letter = block.words.iter().flatten().next().map(|word| word.letter as usize);
        let before = letter.and_then(|at| at.checked_sub(1)).and_then(|at| bytes.get(at));
        let alone = letter == Some(block.start as usize);
        let ending = match &bytes[block.end as usize..block.next as usize] {
            [] if bytes.windows(2).any(|pair| pair == b"\r\n") => b"\r\n".to_vec(),
            [] => b"\n".to_vec(),
            ending => ending.to_vec(),
        };
        Self {
            spaced: if alone { line.contains(&b' ') } else { matches!(before, Some(b' ' | b'\t')) },
            lower: letter.is_some_and(|at| bytes[at].is_ascii_lowercase()),
            two_digits: survey.two_digits,
            keeps_point: survey.keeps_point || dialect == GcodeDialect::Fanuc,
            places,
            ending,
        }
    }

    /// `G0`, `G00`.
    pub(crate) fn code(&self, number: u8) -> String {
        if self.two_digits { format!("G{number:02}") } else { format!("G{number}") }
    }

    /// A count in as few characters as say it.
    pub(crate) fn number(&self, count: i64) -> String {
        let places = usize::from(self.places);
        let digits = format!("{:0width$}", count.unsigned_abs(), width = places + 1);
        let (whole, part) = digits.split_at(digits.len() - places);
        let part = part.trim_end_matches('0');
        let sign = if count < 0 { "-" } else { "" };
        let point = if part.is_empty() && !self.keeps_point { "" } else { "." };
        format!("{sign}{whole}{point}{part}")
    }

    /// A feed, to a tenth of a unit, at least that.
    pub(crate) fn feed(&self, per_min: f64) -> String {
        let tenths = Self { places: 1, ..self.clone() };
        tenths.number(((per_min * 10.0).round() as i64).max(1))
    }

    /// The words of where a move ends and of its circle.
    pub(crate) fn position(&self, end: Counts, each: &Move) -> Vec<String> {
        let mut words = vec![format!("X{}", self.number(end.x)), format!("Y{}", self.number(end.y))];
        if let Some(turn) = each.arc {
            words.push(format!("I{}", self.number(turn.center.x)));
            words.push(format!("J{}", self.number(turn.center.y)));
        }
        words
    }

    /// A whole line.
    pub(crate) fn line(&self, words: &[String], into: &mut Vec<u8>) {
        let text = words.join(if self.spaced { " " } else { "" });
        let text = if self.lower { text.to_ascii_lowercase() } else { text };
        into.extend_from_slice(text.as_bytes());
        into.extend_from_slice(&self.ending);
    }
}
