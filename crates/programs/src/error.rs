//! Why a file can't be read as a program.

use crate::block::Fault;

/// Why a file can't be read as a program.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProgramError {
    /// Longer than [`crate::PROGRAM_BYTE_LIMIT`].
    #[error("the program is longer than {limit} bytes; split it")]
    TooLong {
        /// The limit, bytes.
        limit: usize,
    },
    /// It holds NUL bytes: binary, or UTF-16.
    #[error("line {line} holds a NUL byte, so this is no text; save it as ASCII or UTF-8")]
    NoText {
        /// Counted from 1.
        line: usize,
    },
    /// Nothing in it moves or sets anything.
    #[error("this is no G-code: no line of it is a block of words such as G0 X10")]
    NoBlocks,
    /// More lines are wrong than right.
    #[error("this is no G-code: {faults} lines make no sense, the first is line {line}: {fault}")]
    NoProgram {
        /// The first line that makes no sense.
        line: u32,
        /// Why.
        fault: Fault,
        /// How many lines make no sense.
        faults: u64,
    },
}
