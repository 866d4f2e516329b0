//! One block: a line taken apart into words. Letters are taken in either case, blanks count nowhere.

use crate::decimal::Decimal;
use crate::protection::Protection;
use std::ops::Range;

/// Longer lines are not read; controllers take 255 characters at most.
pub(crate) const LONGEST_LINE: usize = 4096;

/// A letter and its number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Word {
    /// A capital; a comma for the corner words of some controllers (`,R2`).
    pub(crate) letter: u8,
    pub(crate) value: Value,
    /// From the letter to the end of the number, in the line.
    pub(crate) span: Range<usize>,
    /// Where the number begins, in the line.
    pub(crate) number: usize,
}

impl Word {
    /// The number, unless it is an expression.
    pub(crate) fn decimal(&self) -> Option<Decimal> {
        match self.value {
            Value::Number(decimal) => Some(decimal),
            Value::Expression => None,
        }
    }
}

/// What stands behind a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Value {
    Number(Decimal),
    /// A variable or a formula: known to the controller only.
    Expression,
}

/// What a line is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Words, possibly none.
    #[default]
    Words,
    /// `%`.
    TapeMark,
    /// `O1234` or `:1234`.
    ProgramNumber,
    /// Decides which lines run next: O-words, IF, WHILE, GOTO and the like, and `$` commands.
    Control,
    /// Sets a variable.
    Assignment {
        /// Whether it may be one of those that hold offsets.
        of_offsets: bool,
    },
    /// Not understood.
    Fault(Fault),
}

/// Why a line can't be understood.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A character that no block holds.
    #[error("`{}` has no meaning here", (*.0 as char).escape_default())]
    Stray(u8),
    /// A letter without a number.
    #[error("{} has no number", *.0 as char)]
    NoNumber(u8),
    /// More digits than a double holds.
    #[error("the number of {} has too many digits", *.0 as char)]
    TooManyDigits(u8),
    /// `(` without `)`.
    #[error("a comment is not closed")]
    OpenComment,
    /// `[` without `]`.
    #[error("a formula is not closed")]
    OpenFormula,
    /// The same axis twice.
    #[error("{} stands twice in the block", *.0 as char)]
    WordTwice(u8),
    /// Two G codes of one group.
    #[error("two G codes of the block contradict each other")]
    CodesContradict,
    /// A G code that is none.
    #[error("a G code has a number that no controller knows")]
    NoCode,
    /// The line is longer than any controller takes.
    #[error("the line is longer than 4096 characters")]
    LineTooLong,
    /// On Fanuc a number without a point may count in the least increment.
    #[error("the number of {} has no point, so it may count in millimetres or in thousandths", *.0 as char)]
    NoPoint(u8),
}

/// A line, taken apart. Kept from line to line, so that its memory is.
#[derive(Clone, Debug, Default)]
pub(crate) struct Block {
    /// Begins with `/`: the operator decides whether it runs.
    pub(crate) skippable: bool,
    pub(crate) words: Vec<Word>,
    pub(crate) kind: Kind,
    pub(crate) protection: Option<Protection>,
}

impl Block {
    /// Takes apart a line without its end. Cost: linear.
    pub(crate) fn read(&mut self, line: &[u8]) {
        self.words.clear();
        self.skippable = false;
        self.protection = None;
        self.kind = if line.len() > LONGEST_LINE {
            Kind::Fault(Fault::LineTooLong)
        } else {
            Scan { line, at: 0, block: self }.run().unwrap_or_else(Kind::Fault)
        };
    }

    /// Whether nothing stands on the line that a controller acts on: blank, comment, block number.
    pub(crate) fn is_idle(&self) -> bool {
        self.kind == Kind::Words && self.words.iter().all(|word| word.letter == b'N')
    }

    /// The first word with this letter.
    pub(crate) fn word(&self, letter: u8) -> Option<&Word> {
        self.words.iter().find(|word| word.letter == letter)
    }
}

struct Scan<'a> {
    line: &'a [u8],
    at: usize,
    block: &'a mut Block,
}

impl Scan<'_> {
    fn run(&mut self) -> Result<Kind, Fault> {
        while let Some(byte) = self.peek() {
            match byte {
                b'(' => self.comment()?,
                b';' => {
                    self.note(self.at + 1..self.line.len());
                    break;
                }
                b'/' if self.block.words.iter().all(|word| word.letter == b'N') => {
                    self.block.skippable = true;
                    self.at += 1;
                    self.at += usize::from(self.peek().is_some_and(|byte| byte.is_ascii_digit()));
                }
                b'%' if self.block.words.is_empty() => return Ok(Kind::TapeMark),
                b'$' if self.block.words.is_empty() => return Ok(Kind::Control),
                b'#' => return self.assignment(),
                b':' if self.block.words.is_empty() => return Ok(Kind::ProgramNumber),
                b'o' | b'O' => return self.o_word(),
                b',' | b'a'..=b'z' | b'A'..=b'Z' => {
                    if let Some(kind) = self.word()? {
                        return Ok(kind);
                    }
                }
                other => return Err(Fault::Stray(other)),
            }
        }
        self.twice()?;
        Ok(Kind::Words)
    }

    /// The next byte that is no blank; stands before it.
    fn peek(&mut self) -> Option<u8> {
        while matches!(self.line.get(self.at), Some(b' ' | b'\t')) {
            self.at += 1;
        }
        self.line.get(self.at).copied()
    }

    fn comment(&mut self) -> Result<(), Fault> {
        let start = self.at + 1;
        let length = self.line[start..].iter().position(|byte| *byte == b')').ok_or(Fault::OpenComment)?;
        self.note(start..start + length);
        self.at = start + length + 1;
        Ok(())
    }

    fn note(&mut self, comment: Range<usize>) {
        if let Some(protection) = Protection::read(&self.line[comment]) {
            self.block.protection = Some(protection);
        }
    }

    /// A letter and its number; the line's kind when the letter begins a longer word.
    fn word(&mut self) -> Result<Option<Kind>, Fault> {
        let start = self.at;
        let letter = self.line[start].to_ascii_uppercase();
        self.at += 1;
        if letter == b',' {
            self.peek();
            self.at += 1;
        }
        let next = self.peek();
        let number = self.at;
        let value = match next {
            Some(b'[' | b'#' | b'=') => self.expression(letter)?,
            Some(b'-' | b'+') if self.signed_expression() => self.expression(letter)?,
            Some(b'0'..=b'9' | b'.' | b'-' | b'+') => self.number(letter)?,
            Some(byte) if byte.is_ascii_alphabetic() => return Ok(Some(Kind::Control)),
            _ => return Err(Fault::NoNumber(letter)),
        };
        self.block.words.push(Word { letter, value, span: start..self.at, number });
        Ok(None)
    }

    fn signed_expression(&self) -> bool {
        let rest = self.line[self.at..].iter().find(|byte| !matches!(byte, b'-' | b'+' | b' ' | b'\t'));
        matches!(rest, Some(b'[' | b'#'))
    }

    fn number(&mut self, letter: u8) -> Result<Value, Fault> {
        let start = self.at;
        let (mut end, mut signs, mut points) = (start, true, 0);
        while let Some(byte) = self.peek() {
            match byte {
                b'-' | b'+' if signs => {}
                b'.' if points == 0 => points += 1,
                b'0'..=b'9' => {}
                _ => break,
            }
            signs = false;
            self.at += 1;
            end = self.at;
        }
        let text = &self.line[start..end];
        self.at = end;
        let digits = text.iter().copied().filter(|byte| !matches!(byte, b' ' | b'\t'));
        if !digits.clone().any(|byte| byte.is_ascii_digit()) {
            return Err(Fault::NoNumber(letter));
        }
        Decimal::read(digits).map(Value::Number).ok_or(Fault::TooManyDigits(letter))
    }

    /// Passes over `#12`, `#<name>`, `##3`, `[…]` and `=…`.
    fn expression(&mut self, letter: u8) -> Result<Value, Fault> {
        while matches!(self.peek(), Some(b'-' | b'+' | b'#' | b'=')) {
            self.at += 1;
        }
        match self.peek() {
            Some(b'[') => self.bracket()?,
            Some(b'<') => {
                let rest = &self.line[self.at..];
                self.at += 1 + rest.iter().position(|byte| *byte == b'>').ok_or(Fault::OpenFormula)?;
            }
            Some(b'0'..=b'9' | b'.') => {
                self.number(letter)?;
            }
            _ => return Err(Fault::NoNumber(letter)),
        }
        Ok(Value::Expression)
    }

    fn bracket(&mut self) -> Result<(), Fault> {
        let mut depth = 0_usize;
        for (place, byte) in self.line.iter().enumerate().skip(self.at) {
            match byte {
                b'[' => depth += 1,
                b']' => depth = depth.saturating_sub(1),
                _ => {}
            }
            if depth == 0 {
                self.at = place + 1;
                return Ok(());
            }
        }
        Err(Fault::OpenFormula)
    }

    /// `#100=…`: nothing moves, but from 5000 on variables hold offsets.
    fn assignment(&mut self) -> Result<Kind, Fault> {
        if self.block.words.iter().any(|word| word.letter != b'N') {
            // Together with a move: when it takes effect differs by controller.
            return Ok(Kind::Control);
        }
        self.at += 1;
        let of_offsets = match self.peek() {
            Some(b'<') => false,
            Some(b'0'..=b'9') => match self.number(b'#')? {
                Value::Number(number) => number.whole().is_none_or(|number| number >= 5000),
                Value::Expression => true,
            },
            _ => true,
        };
        Ok(Kind::Assignment { of_offsets })
    }

    /// `O1234` alone is a program's number; anything else with an O decides which lines run.
    fn o_word(&mut self) -> Result<Kind, Fault> {
        self.at += 1;
        let numbered = matches!(self.peek(), Some(b'0'..=b'9')) && self.number(b'O').is_ok();
        let alone = matches!(self.peek(), None | Some(b'(' | b';'));
        Ok(if numbered && alone { Kind::ProgramNumber } else { Kind::Control })
    }

    fn twice(&self) -> Result<(), Fault> {
        let mut seen = 0_u32;
        for word in &self.block.words {
            if matches!(word.letter, b'G' | b'M' | b',') {
                continue;
            }
            let bit = 1 << (word.letter - b'A');
            if seen & bit != 0 {
                return Err(Fault::WordTwice(word.letter));
            }
            seen |= bit;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Block {
        let mut block = Block::default();
        block.read(line.as_bytes());
        block
    }

    fn words(line: &str) -> Vec<(char, Option<f64>)> {
        let block = read(line);
        assert_eq!(block.kind, Kind::Words, "{line}");
        block.words.iter().map(|word| (word.letter as char, word.decimal().map(Decimal::value))).collect()
    }

    #[test]
    fn words_are_read_in_any_spelling() {
        let expected = [('G', Some(0.0)), ('X', Some(-1.0)), ('Y', Some(0.5))];
        for line in
            ["G0X-1Y.5", "g00 x-1. y0.5", " G 0 X - 1 Y . 5 ", "G0(to)X-1(the;left)Y.5;done", "/G0X-1Y.5"]
        {
            assert_eq!(words(line), expected, "{line}");
        }
        assert_eq!(words("X#100 Y[#1+[2*3]] Z-#<depth>"), [('X', None), ('Y', None), ('Z', None)]);
        assert!(read("/2 N10 G0").skippable && read("N10/G0").skippable && !read("N10 G0").skippable);
    }

    #[test]
    fn lines_are_told_apart() {
        let kinds = |line: &str| read(line).kind;
        for line in [
            "O100 sub",
            "o<turn> call [1]",
            "IF[#1 EQ 2]GOTO 10",
            "N5 WHILE[#1LT3]DO1",
            "END1",
            "$H",
            "G0 X1 #1=2",
        ] {
            assert_eq!(kinds(line), Kind::Control, "{line}");
        }
        assert_eq!(kinds("O0001 (PART)"), Kind::ProgramNumber);
        assert_eq!(kinds("%"), Kind::TapeMark);
        assert_eq!(kinds("#100=5"), Kind::Assignment { of_offsets: false });
        assert_eq!(kinds("N4 #5221=0"), Kind::Assignment { of_offsets: true });
        for (line, fault) in [
            ("G0 X", Fault::NoNumber(b'X')),
            ("X1 (open", Fault::OpenComment),
            ("X1 X2", Fault::WordTwice(b'X')),
            ("X[1", Fault::OpenFormula),
            ("G0 X1 ?", Fault::Stray(b'?')),
            ("X--1", Fault::NoNumber(b'X')),
            ("X1234567890123456", Fault::TooManyDigits(b'X')),
        ] {
            assert_eq!(kinds(line), Kind::Fault(fault), "{line}");
        }
        assert!(read("N10 (only a note)").is_idle() && read("").is_idle() && !read("G0").is_idle());
    }
}
