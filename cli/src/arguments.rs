//! The command line.

use crate::motion_arguments::MotionArguments;
use crate::order_arguments::Order;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;
use traverse_geometry::{EndRule, Point};

/// Plans how a cutting machine travels: the shortest collision-free rapid move, proven.
#[derive(Debug, Parser)]
#[command(version, about, after_help = EXIT_CODES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 internal error, 2 wrong command line, 3 input that can't be used, \
4 no collision-free path, no tour (proven), 5 the checker found violations, 6 server not reachable, 7 not now (time limit, full \
queue).";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Serves gRPC, gRPC-Web and JSON on one port until SIGINT or SIGTERM.
    Serve(Serve),
    /// Plans the shortest rapid move through a drawing.
    Rapid(Box<Rapid>),
    /// Finds the cheapest place for a tool change between two points of a drawing.
    ToolChange(Box<ToolChange>),
    /// Says what is in a drawing: layers, loops, nesting, unit, what is wrong and what could not be used.
    Inspect(Inspect),
    /// Orders the sections of a cutting layout so that they join tightest.
    Order(Box<Order>),
    /// Orders a TSPLIB matrix (.atsp, .sop, .tsp with listed weights) and prints one JSON line.
    Solve(Solve),
    /// Checks a plan against its request, by code that shares nothing with the planner.
    Check(Check),
    /// Calls any method with proto3 JSON, in process or on a server.
    Call(Call),
    /// Shows what Traverse does: serves, plans on bundled drawings over gRPC, writes pictures.
    Demo(Demo),
}

#[derive(Args, Debug)]
pub(crate) struct Serve {
    /// Where to listen. Port 0: any free one; the address is printed.
    #[arg(long, default_value = "127.0.0.1:50051", value_name = "ADDR:PORT")]
    pub(crate) listen: SocketAddr,
    /// How the log on standard error looks. RUST_LOG chooses what is in it.
    #[arg(long, value_enum, default_value_t = LogStyle::Text)]
    pub(crate) log_format: LogStyle,
    /// Engines that run at once. Default: one per core.
    #[arg(long, value_name = "COUNT")]
    pub(crate) workers: Option<usize>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum LogStyle {
    /// For people.
    Text,
    /// One object per line, for programs.
    Json,
}

/// A drawing, and how it is read.
#[derive(Args, Debug)]
pub(crate) struct DrawingFile {
    /// DXF or SVG file: closed outlines; the layer WORK_AREA, WORKAREA or TABLE bounds the work area.
    pub(crate) drawing: PathBuf,
    /// What bounds the work area: a layer, or id:NAME, group:NAME, color:#RRGGBB; * stands for anything. Repeat for more.
    #[arg(long, value_name = "SELECTOR")]
    pub(crate) work_area: Vec<String>,
    /// What is an obstacle: a layer, or id:NAME, group:NAME, color:#RRGGBB; * stands for anything. Repeat for more.
    /// Default: everything else.
    #[arg(long, value_name = "SELECTOR")]
    pub(crate) obstacles: Vec<String>,
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
    /// TOML file of machine profiles: roles, clearances, G-code. What is said here on the command line goes first.
    #[arg(long, value_name = "FILE", requires = "machine")]
    pub(crate) machines: Option<PathBuf>,
    /// Name of the machine in the file of profiles.
    #[arg(long, value_name = "NAME", requires = "machines")]
    pub(crate) machine: Option<String>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Unit {
    /// Millimetres.
    Mm,
    /// Inches.
    Inch,
}

#[derive(Args, Debug)]
pub(crate) struct Inspect {
    #[command(flatten)]
    pub(crate) file: DrawingFile,
    /// Writes a picture of the drawing that marks what is wrong: .svg or .png. Repeat for more.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// Width of .png pictures, pixels.
    #[arg(long, value_name = "PX", default_value_t = 1600)]
    pub(crate) width: u32,
}

#[derive(Args, Debug)]
pub(crate) struct Rapid {
    #[command(flatten)]
    pub(crate) file: DrawingFile,
    /// Where the tool's centre is, millimetres. With --program: where it stands when the program begins, if known.
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true, required_unless_present = "program")]
    pub(crate) from: Option<Point>,
    /// Where it has to go, millimetres.
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true, required_unless_present = "program")]
    pub(crate) to: Option<Point>,
    /// Replaces the rapid moves of this G-code program instead, and tells what that saves. Write it with -o OUT.nc.
    #[arg(long, value_name = "FILE", group = "passing_over", conflicts_with_all = ["to", "request", "server", "algorithm", "leave", "enter", "start_z", "alternatives"])]
    pub(crate) program: Option<PathBuf>,
    /// At this Z of the program, millimetres, and above it nothing is in the way. Default: nowhere.
    #[arg(long, value_name = "MM", allow_hyphen_values = true, requires = "program")]
    pub(crate) safe_z: Option<f64>,
    /// Feeds arcs as G2 and G3 at this speed. Default: the profile's; without one the arcs of a program are straight G0 moves
    /// outside them.
    #[arg(long, value_name = "MM_PER_MIN")]
    pub(crate) arc_feed: Option<f64>,
    /// Distance that the tool's centre keeps from obstacles, millimetres: radius plus margin. May come from --machine.
    /// Several (6,4,2.5) are tried largest first; the first that admits a path counts.
    #[arg(
        long,
        value_name = "MM[,MM…]",
        value_delimiter = ',',
        allow_hyphen_values = true,
        required_unless_present = "machine"
    )]
    pub(crate) clearance: Vec<f64>,
    /// Distance kept from the work area's border, millimetres. Default: the clearance.
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub(crate) border_clearance: Option<f64>,
    /// What happens where the start lies inside a barrier: refuse, nearest (out by the shortest straight way), or X,Y, the
    /// direction to go out in.
    #[arg(long, value_name = "refuse|nearest|X,Y", default_value = "refuse", value_parser = end_rule, allow_hyphen_values = true)]
    pub(crate) leave: EndRule,
    /// The same for the target; the direction is seen from the target outwards.
    #[arg(long, value_name = "refuse|nearest|X,Y", default_value = "refuse", value_parser = end_rule, allow_hyphen_values = true)]
    pub(crate) enter: EndRule,
    /// Height of the start, millimetres. With it the tool may rise and pass over what is low enough.
    #[arg(
        long,
        value_name = "MM",
        allow_hyphen_values = true,
        group = "passing_over",
        requires = "highest_z"
    )]
    pub(crate) start_z: Option<f64>,
    /// Height of the target, millimetres. Default: the start's.
    #[arg(long, value_name = "MM", allow_hyphen_values = true, requires = "start_z")]
    pub(crate) target_z: Option<f64>,
    /// The tool never goes higher, millimetres. With --program: of the program's Z; default: its own highest rapid move.
    #[arg(long, value_name = "MM", allow_hyphen_values = true, requires = "passing_over")]
    pub(crate) highest_z: Option<f64>,
    /// Kept above every top that is passed over, millimetres. Default: the largest clearance.
    #[arg(long, value_name = "MM", allow_hyphen_values = true, requires = "passing_over")]
    pub(crate) clearance_z: Option<f64>,
    /// Height of the top of every obstacle for which the machine's profile names none, millimetres. Without one an obstacle
    /// can't be passed over. With --program retracts are planned, too, as soon as a top is known; tops count in its Z.
    #[arg(long, value_name = "MM", allow_hyphen_values = true, requires = "passing_over")]
    pub(crate) top: Option<f64>,
    /// How barriers turn convex corners. Default: round.
    #[arg(long, value_enum)]
    pub(crate) corner: Option<Corner>,
    #[command(flatten)]
    pub(crate) motion: MotionArguments,
    /// By which method.
    #[arg(long, value_enum, default_value_t = Method::Exact)]
    pub(crate) algorithm: Method,
    /// So many other ways round are wanted as well, shortest first, at most 16.
    #[arg(long, value_name = "COUNT", default_value_t = 0)]
    pub(crate) alternatives: usize,
    /// Stop after this long, seconds. Default: the server's; with --program no limit.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) time_limit: Option<Duration>,
    /// Plan although parts of the drawing could not be used: the path may run through them.
    #[arg(long)]
    pub(crate) ignore_unused: bool,
    /// Writes the plan: .svg or .png a picture, .json a PlanRapidMoveResponse, .dxf a drawing, .nc G-code for --machine
    /// or the rewritten --program.
    /// Repeat for more.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// Width of .png pictures, pixels.
    #[arg(long, value_name = "PX", default_value_t = 1600)]
    pub(crate) width: u32,
    /// Writes the PlanRapidMoveRequest as JSON, for `traverse check` and `traverse call`.
    #[arg(long, value_name = "FILE")]
    pub(crate) request: Option<PathBuf>,
    /// Ask this server instead of planning in process.
    #[arg(long, value_name = "URL")]
    pub(crate) server: Option<String>,
}

/// A tool change, and the moves there and on.
#[derive(Args, Debug)]
pub(crate) struct ToolChange {
    /// Where the tool may be changed: a layer, or id:NAME, group:NAME, color:#RRGGBB; * stands for anything. Its loops are
    /// no obstacles. Repeat for more.
    #[arg(long, value_name = "SELECTOR", required_unless_present = "at")]
    pub(crate) region: Vec<String>,
    /// A point where it may be changed as well, millimetres. Repeat for more.
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub(crate) at: Vec<Point>,
    /// Height at which it is changed, millimetres. Default: --highest-z.
    #[arg(long, value_name = "MM", allow_hyphen_values = true, requires = "start_z")]
    pub(crate) place_z: Option<f64>,
    /// As of rapid moves; outputs are .svg or .png pictures and .json a PlaceToolChangeResponse.
    #[command(flatten)]
    pub(crate) rapid: Rapid,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Corner {
    /// By arcs: the true distance.
    Round,
    /// By parallel lines that meet, as published in 2008.
    Miter,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Method {
    /// The shortest path, proven.
    Exact,
    /// The scan published in 2008, for comparison: one obstacle, mitred.
    SupportingLines,
}

#[derive(Args, Debug)]
pub(crate) struct Check {
    /// PlanRapidMoveRequest (`traverse rapid --request`) or OrderSectionsRequest (`traverse order --request`) as JSON, - for
    /// standard input.
    pub(crate) request: PathBuf,
    /// PlanRapidMoveResponse (`traverse rapid -o plan.json`) or OrderSectionsResponse (`traverse order -o layout.json`) as
    /// JSON, - for standard input.
    pub(crate) plan: PathBuf,
    /// How far inside a barrier, or nearer than the gap, still counts as touching, millimetres.
    #[arg(long, value_name = "MM")]
    pub(crate) tolerance: Option<f64>,
    /// Ask this server instead of checking in process.
    #[arg(long, value_name = "URL")]
    pub(crate) server: Option<String>,
}

#[derive(Args, Debug)]
pub(crate) struct Call {
    /// Such as PlanRapidMove, PlanRapidMoves, PlanDistances, OrderSections, GetLimits.
    pub(crate) method: String,
    /// The request as proto3 JSON, - for standard input. For PlanRapidMoves steps, one per line; each is answered by a line.
    pub(crate) request: PathBuf,
    /// Ask this server instead of the engines in process.
    #[arg(long, value_name = "URL")]
    pub(crate) server: Option<String>,
}

#[derive(Args, Debug)]
pub(crate) struct Demo {
    /// Where the pictures go.
    #[arg(long, value_name = "FOLDER", default_value = "out/demo")]
    pub(crate) out: PathBuf,
}

#[derive(Args, Debug)]
pub(crate) struct Solve {
    /// A TSPLIB file with explicit weights; `-` reads standard input.
    pub(crate) file: PathBuf,
    /// Stop after this long, such as 60s, and answer with the best so far.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, default_value = "60s")]
    pub(crate) time_limit: Duration,
    /// Stop after this many iterations. The same limit, seed and one thread give the same answer.
    #[arg(long, value_name = "COUNT")]
    pub(crate) iteration_limit: Option<u64>,
    /// Where chance comes from.
    #[arg(long, default_value_t = 0)]
    pub(crate) seed: u64,
    /// 2 or more: local search beside the proof.
    #[arg(long, value_name = "COUNT", default_value_t = 1)]
    pub(crate) threads: usize,
    /// The ladder, or a method published in 2009.
    #[arg(long, value_enum, default_value_t = SolveMethod::Ladder)]
    pub(crate) method: SolveMethod,
    /// Prints the order of visits too, nodes counted from 0.
    #[arg(long)]
    pub(crate) tour: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SolveMethod {
    /// Whatever proves the optimum soonest.
    Ladder,
    /// Branch and bound on one arc in or out, bounded by assignments.
    BranchAndBound,
    /// An ant colony.
    AntColony,
    /// Successive improvement.
    SuccessiveImprovement,
}

impl From<SolveMethod> for traverse_tours::Method {
    fn from(method: SolveMethod) -> Self {
        match method {
            SolveMethod::Ladder => Self::Ladder,
            SolveMethod::BranchAndBound => Self::BranchAndBound,
            SolveMethod::AntColony => Self::AntColony,
            SolveMethod::SuccessiveImprovement => Self::SuccessiveImprovement,
        }
    }
}

/// A time in seconds.
pub(crate) fn seconds(text: &str) -> Result<Duration, String> {
    let wrong = || format!("{text} is no time; write seconds, such as 2.5 or 60s");
    let seconds: f64 = text.strip_suffix('s').unwrap_or(text).parse().map_err(|_| wrong())?;
    Duration::try_from_secs_f64(seconds).map_err(|_| wrong())
}

/// `X,Y` in millimetres.
fn point(text: &str) -> Result<Point, String> {
    let wrong = || format!("{text} is no point; write X,Y in millimetres, such as 12.5,-3");
    let (x, y) = text.split_once(',').ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().map_err(|_| wrong());
    Ok(Point::new(number(x)?, number(y)?))
}

/// What happens at an end inside a barrier.
fn end_rule(text: &str) -> Result<EndRule, String> {
    match text {
        "refuse" => Ok(EndRule::Refuse),
        "nearest" => Ok(EndRule::Nearest),
        _ => point(text)
            .map(|p| EndRule::Direction(p.coords))
            .map_err(|_| format!("{text} is no rule; write refuse, nearest, or a direction X,Y such as 0,1")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn points_are_pairs_of_numbers() {
        assert_eq!(point("1.5, -2"), Ok(Point::new(1.5, -2.0)));
        for wrong in ["", "1", "1;2", "a,b", "1,2,3"] {
            assert!(point(wrong).is_err(), "{wrong}");
        }
    }
}
