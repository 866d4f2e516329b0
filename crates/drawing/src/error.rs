//! Why a drawing can't be read at all.

/// Why a drawing can't be read at all. What can be read but not used is no error: see [`crate::Unused`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The reader itself failed.
    #[error("the drawing can't be read: {message}; check the path and its permissions")]
    Io {
        /// What the system says.
        message: String,
    },
    /// Longer than [`crate::ReadOptions::byte_limit`].
    #[error("the drawing is longer than {limit} bytes; split it, or take out what is not needed")]
    TooLong {
        /// The limit, bytes.
        limit: u64,
    },
    /// Nothing in it.
    #[error("the drawing is empty; export it again")]
    Empty,
    /// Not a DXF file.
    #[error("this is not a DXF file but {found}; export the drawing as DXF (ASCII or binary)")]
    NotDxf {
        /// What it looks like.
        found: &'static str,
    },
    /// Not an SVG file.
    #[error("this is not an SVG file but {found}; export the drawing as plain SVG, not compressed")]
    NotSvg {
        /// What it looks like.
        found: &'static str,
    },
    /// Neither a DXF nor an SVG file.
    #[error("this is neither a DXF nor an SVG file but {found}; export the drawing as DXF or plain SVG")]
    NotDrawing {
        /// What it looks like.
        found: &'static str,
    },
    /// The end of the file is missing.
    #[error("the file ends at line {line} without 0/EOF, so part of it is missing; export or copy it again")]
    Truncated {
        /// The last line, counted from 1; 0 for a binary file.
        line: usize,
    },
    /// The text is not what DXF prescribes at this place.
    #[error("line {line}: {message}; export the drawing again")]
    Malformed {
        /// Counted from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// A coordinate, radius, angle or bulge that is no finite number or is out of range.
    #[error(
        "{}{entity} on layer {layer}: {field} is {}, outside ±{limit}; repair the drawing or its units",
        at_line(*.line),
        shown(*.value)
    )]
    NumberOutOfRange {
        /// Line that says its type, counted from 1; 0 in a binary file.
        line: usize,
        /// Entity type, such as `LINE`.
        entity: &'static str,
        /// Its layer.
        layer: String,
        /// Which number.
        field: &'static str,
        /// The number, millimetres for lengths.
        value: f64,
        /// Largest absolute value, in the unit of `value`.
        limit: f64,
    },
    /// More vertices than [`crate::ReadOptions::vertex_limit`].
    #[error(
        "the drawing has more than {limit} vertices; split it, take out what is not needed, or fit curves less closely"
    )]
    TooManyVertices {
        /// The limit.
        limit: usize,
    },
    /// More entities than [`crate::ReadOptions::entity_limit`].
    #[error("the drawing has more than {limit} entities; split it, or take out what is not needed")]
    TooManyEntities {
        /// The limit.
        limit: usize,
    },
    /// An attribute of an SVG element that can't be read, or that puts something out of range.
    #[error("line {line}: {attribute} of {element} is `{value}`: {problem}; repair the drawing")]
    BadAttribute {
        /// Line of the element, counted from 1.
        line: usize,
        /// The element with its id, such as `<rect id="clamp">`.
        element: String,
        /// Which attribute.
        attribute: &'static str,
        /// Its value, shortened.
        value: String,
        /// What is wrong.
        problem: String,
    },
    /// Elements nested deeper than is read, uses of symbols included.
    #[error("line {line}: elements are nested more than {limit} deep; ungroup some")]
    TooDeep {
        /// The limit.
        limit: usize,
        /// Line of the element that is too deep, counted from 1.
        line: usize,
    },
    /// An SVG `use` element that is part of what it refers to.
    #[error("line {line}: <use> of `{reference}` contains itself; break the circle")]
    UseCycle {
        /// Line of the element that closes the circle, counted from 1.
        line: usize,
        /// What it refers to.
        reference: String,
    },
    /// More text than [`crate::ReadOptions::byte_limit`] once all that is used again and again is written out.
    #[error(
        "the drawing is longer than {limit} bytes once all its uses and entities are written out; simplify it"
    )]
    TooMuchRepeated {
        /// The limit, bytes.
        limit: u64,
    },
    /// Blocks that hold themselves.
    #[error("block {} holds itself; take the INSERT out of it that closes the ring", .blocks.join(" → "))]
    BlockCycle {
        /// Names of the blocks, each the holder of the next; the last is the first once more. Of long rings, the
        /// beginning and the end.
        blocks: Vec<String>,
    },
    /// Names of blocks, once for each curve inside, that are longer together than [`crate::ReadOptions::byte_limit`].
    #[error("the names of the blocks round all curves take more than {limit} bytes; explode nested blocks")]
    TooMuchNesting {
        /// The limit, bytes.
        limit: u64,
    },
}

/// Numbers from here on are written with their power of ten.
const LARGEST_WRITTEN_OUT: f64 = 1e15;

/// A number of any size in a few letters.
fn shown(value: f64) -> String {
    if value.is_finite() && value.abs() >= LARGEST_WRITTEN_OUT {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}

/// Where text has lines; binary files have none.
fn at_line(line: usize) -> String {
    if line == 0 { String::new() } else { format!("line {line}: ") }
}
