//! TSPLIB files with explicit matrices: asymmetric (.atsp), sequential ordering (.sop), symmetric (.tsp) as far as
//! their weights are listed. After the format description of TSPLIB 95 (G. Reinelt).
//!
//! In a .sop file −1 at (i, j) says that i comes after j, the matrix may be preceded by its size, and the tour is a
//! path from the first node to the last. The diagonal of a bare matrix means nothing and becomes forbidden.

use crate::cost::{FORBIDDEN, LARGEST_COST};
use crate::specification::TourSpecification;
use crate::{CostMatrix, Finding};

/// The largest dimension that is read: a matrix of 200 MB.
pub const LARGEST_DIMENSION: usize = 5_000;

/// Why a file can't be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TsplibError {
    /// A line that can't be used.
    #[error("line {line}: {what} is {value:?}: {expected}")]
    Line {
        /// Line number, from 1.
        line: usize,
        /// What stands there.
        what: &'static str,
        /// The text as it stands, cut to 40 characters.
        value: String,
        /// What would be right.
        expected: &'static str,
    },
    /// Something is missing.
    #[error("{what} is missing: {expected}")]
    Missing {
        /// What is missing.
        what: &'static str,
        /// What would be right.
        expected: &'static str,
    },
    /// The weights are not as many as the format says.
    #[error("EDGE_WEIGHT_SECTION has {found} numbers: {expected} for this dimension and format")]
    WeightCount {
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// The matrix can be read but not solved.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Findings(Vec<Finding>),
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Tours,
    SequentialOrdering,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Full,
    UpperRow,
    LowerRow,
    UpperDiagonalRow,
    LowerDiagonalRow,
}

/// What is to be ordered, from the text of a TSPLIB file.
///
/// # Errors
/// The first line that can't be used, or what is missing.
pub fn read_tsplib(text: &str) -> Result<TourSpecification, TsplibError> {
    let mut header = Header::default();
    let mut weights: Option<Vec<i64>> = None;
    let mut lines = text.lines().enumerate().map(|(at, line)| (at + 1, line.trim())).peekable();
    while let Some((line, content)) = lines.next() {
        let (keyword, value) = match content.split_once(':') {
            Some((keyword, value)) => (keyword.trim(), value.trim()),
            None => (content, ""),
        };
        match keyword {
            "EOF" => break,
            "EDGE_WEIGHT_SECTION" => {
                let most = header.most_weights()?;
                let mut numbers = vec![];
                while let Some((line, row)) =
                    lines.next_if(|(_, row)| row.is_empty() || begins_with_number(row))
                {
                    for word in row.split_whitespace() {
                        numbers.push(weight(line, word)?);
                        if numbers.len() > most {
                            return Err(TsplibError::WeightCount {
                                found: numbers.len(),
                                expected: most - 1,
                            });
                        }
                    }
                }
                weights = Some(numbers);
            }
            _ => header.take(line, keyword, value)?,
        }
    }
    let weights = weights.ok_or(TsplibError::Missing {
        what: "EDGE_WEIGHT_SECTION",
        expected: "only explicit weights can be read",
    })?;
    header.specification(weights)
}

#[derive(Default)]
struct Header {
    kind: Option<Kind>,
    dimension: Option<usize>,
    format: Option<Format>,
}

impl Header {
    fn take(&mut self, line: usize, keyword: &str, value: &str) -> Result<(), TsplibError> {
        let wrong = |what, expected| Err(TsplibError::Line { line, what, value: short(value), expected });
        match keyword {
            "TYPE" => {
                self.kind = Some(match value.split_whitespace().next() {
                    Some("ATSP" | "TSP") => Kind::Tours,
                    Some("SOP") => Kind::SequentialOrdering,
                    _ => return wrong("TYPE", "use ATSP, SOP or TSP"),
                });
            }
            "DIMENSION" => match value.parse::<usize>() {
                Ok(size) if (1..=LARGEST_DIMENSION).contains(&size) => self.dimension = Some(size),
                _ => return wrong("DIMENSION", "use a whole number from 1 to 5000"),
            },
            "EDGE_WEIGHT_TYPE" if value != "EXPLICIT" => {
                return wrong("EDGE_WEIGHT_TYPE", "only EXPLICIT can be read");
            }
            "EDGE_WEIGHT_FORMAT" => {
                self.format = Some(match value {
                    "FULL_MATRIX" => Format::Full,
                    "UPPER_ROW" => Format::UpperRow,
                    "LOWER_ROW" => Format::LowerRow,
                    "UPPER_DIAG_ROW" => Format::UpperDiagonalRow,
                    "LOWER_DIAG_ROW" => Format::LowerDiagonalRow,
                    _ => {
                        return wrong(
                            "EDGE_WEIGHT_FORMAT",
                            "use FULL_MATRIX, UPPER_ROW, LOWER_ROW, UPPER_DIAG_ROW or LOWER_DIAG_ROW",
                        );
                    }
                });
            }
            "" | "NAME" | "COMMENT" | "EDGE_WEIGHT_TYPE" | "DISPLAY_DATA_TYPE" => {}
            _ if begins_with_number(keyword) => {
                return Err(TsplibError::Line {
                    line,
                    what: "a number outside EDGE_WEIGHT_SECTION",
                    value: short(keyword),
                    expected: "numbers stand in one block behind EDGE_WEIGHT_SECTION",
                });
            }
            // Other keywords and comments that run over several lines.
            _ => {}
        }
        Ok(())
    }

    fn dimension(&self) -> Result<usize, TsplibError> {
        self.dimension
            .ok_or(TsplibError::Missing { what: "DIMENSION", expected: "it stands before the weights" })
    }

    fn format(&self) -> Format {
        self.format.unwrap_or(Format::Full)
    }

    fn expected_weights(&self) -> Result<usize, TsplibError> {
        let size = self.dimension()?;
        Ok(match self.format() {
            Format::Full => size * size,
            Format::UpperRow | Format::LowerRow => size * (size - 1) / 2,
            Format::UpperDiagonalRow | Format::LowerDiagonalRow => size * (size + 1) / 2,
        })
    }

    fn most_weights(&self) -> Result<usize, TsplibError> {
        Ok(self.expected_weights()? + 1)
    }

    fn specification(&self, mut weights: Vec<i64>) -> Result<TourSpecification, TsplibError> {
        let size = self.dimension()?;
        let expected = self.expected_weights()?;
        // Some matrices, those of .sop files among them, are preceded by their size.
        if weights.len() == expected + 1 && weights[0] == size as i64 {
            weights.remove(0);
        }
        if weights.len() != expected {
            return Err(TsplibError::WeightCount { found: weights.len(), expected });
        }
        let ordered = self.kind == Some(Kind::SequentialOrdering);
        let mut entries = vec![FORBIDDEN; size * size];
        let mut precedence = vec![];
        let mut numbers = weights.into_iter();
        for row in 0..size {
            let columns = match self.format() {
                Format::Full => 0..size,
                Format::UpperRow => row + 1..size,
                Format::LowerRow => 0..row,
                Format::UpperDiagonalRow => row..size,
                Format::LowerDiagonalRow => 0..row + 1,
            };
            for (column, cost) in columns.zip(&mut numbers) {
                if row == column {
                    continue;
                }
                if ordered && cost == -1 {
                    precedence.push((column, row));
                    continue;
                }
                entries[row * size + column] = cost;
                if self.format() != Format::Full {
                    entries[column * size + row] = cost;
                }
            }
        }
        let costs = CostMatrix::new(size, entries).map_err(TsplibError::Findings)?;
        let specification = if ordered {
            let (first, last) = (Some(0), Some(size - 1));
            // That the first comes first and the last comes last is said by the ends already.
            precedence.retain(|&(before, after)| before != 0 && after != size - 1);
            TourSpecification { first, last, precedence, ..TourSpecification::path(costs) }
        } else {
            TourSpecification::cycle(costs)
        };
        let findings = specification.findings();
        if findings.is_empty() { Ok(specification) } else { Err(TsplibError::Findings(findings)) }
    }
}

fn begins_with_number(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+' || c == '.')
}

fn weight(line: usize, word: &str) -> Result<i64, TsplibError> {
    let whole = word.parse::<i64>().ok().or_else(|| {
        let value = word.parse::<f64>().ok()?;
        (value.fract() == 0.0 && value.abs() <= LARGEST_COST as f64).then_some(value as i64)
    });
    whole.filter(|cost| (-LARGEST_COST..=LARGEST_COST).contains(cost)).ok_or(TsplibError::Line {
        line,
        what: "a weight",
        value: short(word),
        expected: "use whole numbers of at most 100 000 000 000 either way",
    })
}

fn short(text: &str) -> String {
    text.chars().take(40).collect()
}
