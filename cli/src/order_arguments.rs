//! The command line of `traverse order`.

use crate::arguments::{Unit, seconds};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::time::Duration;

#[derive(Args, Debug)]
pub(crate) struct Order {
    /// DXF or SVG drawings of sections, or ESICUP-style part sets (.json), which are built into blocks of the strip's height.
    #[arg(required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Writes the layout: .svg or .png a picture, .dxf a drawing, .json an OrderSectionsResponse. Repeat for more.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// How every section may be turned.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "as-is")]
    pub(crate) poses: Vec<PoseChoice>,
    /// Kept between parts of different sections, millimetres.
    #[arg(long, value_name = "MM", default_value_t = 0.0, allow_hyphen_values = true)]
    pub(crate) gap: f64,
    /// Stop after this long, such as 10s, and answer with the best so far.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, default_value = "10s")]
    pub(crate) time: Duration,
    /// Height of the strip, millimetres: no section may be higher. Of a part set: instead of its own.
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub(crate) strip_height: Option<f64>,
    /// How far sections slide left.
    #[arg(long, value_enum, default_value_t = Slide::KeepOrder)]
    pub(crate) slide: Slide,
    /// By which method the order is decided.
    #[arg(long, value_enum, default_value_t = OrderMethod::Best)]
    pub(crate) algorithm: OrderMethod,
    /// Which effects of joins decide the order.
    #[arg(long, value_enum, default_value_t = Effects::Exact)]
    pub(crate) effects: Effects,
    /// What of a drawing is a section.
    #[arg(long, value_enum, default_value_t = SectionsChoice::Found)]
    pub(crate) sections: SectionsChoice,
    /// What of a drawing is left out: a layer, or id:NAME, group:NAME, color:#RRGGBB. Repeat for more. Default: the layers
    /// WORK_AREA, WORKAREA, TABLE.
    #[arg(long, value_name = "SELECTOR")]
    pub(crate) ignore: Vec<String>,
    /// How many copies of a section there are. Default: as many as are drawn. Repeat for more.
    #[arg(long, value_name = "ID=COUNT", value_parser = copies)]
    pub(crate) copies: Vec<(String, u32)>,
    /// One copy of this section comes first.
    #[arg(long, value_name = "ID")]
    pub(crate) first: Option<String>,
    /// One copy of this section comes last.
    #[arg(long, value_name = "ID")]
    pub(crate) last: Option<String>,
    /// All copies of one section before all copies of another. Repeat for more.
    #[arg(long, value_name = "ID,ID", value_parser = pair)]
    pub(crate) before: Vec<(String, String)>,
    /// The second section must not be the right neighbour of the first. Repeat for more.
    #[arg(long, value_name = "ID,ID", value_parser = pair)]
    pub(crate) forbid: Vec<(String, String)>,
    /// Parts may overlap inside their own section.
    #[arg(long)]
    pub(crate) allow_overlap: bool,
    /// Stop when (length − bound) / length is at most this.
    #[arg(long, value_name = "RATIO", default_value_t = 0.0)]
    pub(crate) gap_limit: f64,
    /// Stop after this many steps. The same limit, seed and one thread give the same answer.
    #[arg(long, value_name = "COUNT", default_value_t = 0)]
    pub(crate) iteration_limit: i64,
    /// Where chance comes from; also of the blocks that are built.
    #[arg(long, default_value_t = 0)]
    pub(crate) seed: u32,
    /// Threads that work on it.
    #[arg(long, value_name = "COUNT", default_value_t = 1)]
    pub(crate) threads: i32,
    /// Of a part set: how many blocks are built. Default: as many as its demand fills.
    #[arg(long, value_name = "COUNT")]
    pub(crate) blocks: Option<usize>,
    /// Of a part set: columns of a block.
    #[arg(long, value_name = "COUNT", default_value_t = 2)]
    pub(crate) columns: usize,
    /// Ends of lines that are no farther apart are joined, millimetres.
    #[arg(long, value_name = "MM", default_value_t = traverse_drawing::JOIN_TOLERANCE_MM)]
    pub(crate) join: f64,
    /// Unit of a DXF file that names none.
    #[arg(long, value_enum, default_value_t = Unit::Mm)]
    pub(crate) unit: Unit,
    /// Pixels per inch of an SVG file whose page has no size in millimetres or inches.
    #[arg(long, value_name = "COUNT", default_value_t = 96.0)]
    pub(crate) dpi: f64,
    /// How far arcs may run from an ellipse or a spline that they stand for, millimetres.
    #[arg(long, value_name = "MM", default_value_t = 0.001)]
    pub(crate) fit: f64,
    /// Go on although parts of a drawing could not be used: the layout is without them.
    #[arg(long)]
    pub(crate) ignore_unused: bool,
    /// Width of .png pictures, pixels.
    #[arg(long, value_name = "PX", default_value_t = 1600)]
    pub(crate) width: u32,
    /// Writes the OrderSectionsRequest as JSON, for `traverse check` and `traverse call`.
    #[arg(long, value_name = "FILE")]
    pub(crate) request: Option<PathBuf>,
    /// Ask this server instead of ordering in process.
    #[arg(long, value_name = "URL")]
    pub(crate) server: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PoseChoice {
    /// As it is drawn.
    AsIs,
    /// Turned by half a turn.
    HalfTurn,
    /// Left and right swapped.
    MirrorX,
    /// Top and bottom swapped.
    MirrorY,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Slide {
    /// None passes the left edge of the one before it.
    KeepOrder,
    /// Sections may tuck in further left.
    Free,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum OrderMethod {
    /// The best that is known for the question.
    Best,
    /// None: the order of the drawing.
    GivenOrder,
    /// Published 2009: bounded by assignments.
    BranchAndBound,
    /// Published 2009: an ant colony.
    AntColony,
    /// Published 2009: successive improvement.
    LocalImprovement,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Effects {
    /// The true ones.
    Exact,
    /// From local extremes only, as published in 2009.
    Published,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SectionsChoice {
    /// Groups or blocks where there are any, otherwise layers where there are several, otherwise every part.
    Found,
    /// Each group of an SVG file that stands in no other, layers aside.
    Group,
    /// Each block of a DXF file that stands in no other, as often as it is inserted.
    Block,
    /// Each layer.
    Layer,
    /// Each part.
    Part,
}

/// `ID=COUNT`.
fn copies(text: &str) -> Result<(String, u32), String> {
    let wrong = || format!("{text} is no count of copies; write ID=COUNT, such as soles=4");
    let (id, count) = text.rsplit_once('=').ok_or_else(wrong)?;
    Ok((id.to_owned(), count.parse().map_err(|_| wrong())?))
}

/// `ID,ID`.
fn pair(text: &str) -> Result<(String, String), String> {
    let wrong = || format!("{text} is no pair of sections; write ID,ID, such as soles,heels");
    let (one, other) = text.split_once(',').ok_or_else(wrong)?;
    Ok((one.trim().to_owned(), other.trim().to_owned()))
}
