//! The shortest collision-free rapid move round obstacles: exact for any number of them, convex or not, with holes
//! and arcs, touching and overlapping, with and without a work area, for clearance 0, round and mitred corners.
//!
//! Rules let the tool pass over what is low, leave and enter barriers, and try clearances in turn. They say what travel
//! costs (`measure`, `price`): length or the seconds of axes that run at their own speeds, both proven; or seconds with
//! acceleration (`kinematics`, `quickest`), with a bound. And they say how the machine runs a route (`drive`): dog-legs in the
//! place of straight moves, chords in the place of arcs.
//!
//! The data's way: clearances are tried in turn (`rapid_move`); at each a [`traverse_geometry::Scene`] is taken apart
//! into barriers (`barriers`, `barrier`), the ends are led out of them (`way_out`) and placed (`standing`), the levels
//! that matter (`level`) are searched (`at_clearance`, `search`), and the route is traced back into moves (`trace`).
//! Where there is no path, `feasible` says how much clearance one could keep. Beside it stands the scan published in
//! 2008 (`supporting_lines`).
//!
//! Many moves in one scene, which may change between them, are planned in a [`PreparedScene`] (`prepared`): it keeps what
//! can be seen from where, and answers what a fresh scene would. What many moves between points would cost is worked out
//! from each point to all others at once (`distances`).
//!
//! ```
//! use traverse_geometry::{CornerStyle, Obstacle, Point, Polygon, RapidRules, Ring, Scene};
//! use traverse_planner::{Algorithm, Answer, RapidMove, plan_rapid_move};
//! use traverse_solve::{Budget, Silent};
//!
//! let square = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)];
//! let ring = Ring::new(square.map(|(x, y)| Point::new(x, y)).to_vec(), vec![]).expect("a valid ring");
//! let obstacle = Obstacle { id: "block".into(), shape: Polygon::from_ring(ring), clearance_mm: None, top_z_mm: None };
//! let scene = Scene {
//!     work_area: None,
//!     obstacles: vec![obstacle],
//!     clearance_mm: 3.0,
//!     work_area_clearance_mm: None,
//!     corner_style: CornerStyle::Round,
//! };
//! let query = RapidMove {
//!     start: Point::new(-5.0, 2.0),
//!     target: Point::new(15.0, 2.0),
//!     algorithm: Algorithm::Exact,
//!     rules: RapidRules::default(),
//! };
//! let (answer, _stats) = plan_rapid_move(&scene, &query, &Budget::unlimited(), &mut Silent).expect("free ends");
//! let Answer::Plan(plan) = answer else { panic!("a block parts nothing") };
//! assert_eq!(plan.cost, plan.lower_bound);
//! assert_eq!(plan.bending_obstacles, ["block"]);
//! assert!((plan.cost - 24.772_547).abs() < 1e-6, "{}", plan.cost);
//! ```

mod at_clearance;
mod barrier;
mod barriers;
mod distances;
mod drive;
mod ends;
mod feasible;
mod kinematics;
mod level;
mod lowered;
mod measure;
mod places;
mod plan;
mod prepared;
mod price;
mod quickest;
mod rapid_move;
mod search;
mod separating;
mod shortest_route;
mod standing;
mod supporting_lines;
mod told;
mod tool_change;
mod trace;
mod way_out;

pub use distances::{DistanceEnd, DistanceQuery, DistancesRefusal, plan_distances};
pub use drive::as_run;
pub use plan::{Algorithm, Answer, FeasibleClearance, NoPath, RapidMove, RapidPlan, Refusal, Stats};
pub use prepared::{EditRefusal, PreparedScene, SceneEdit};
pub use price::travel_cost;
pub use rapid_move::plan_rapid_move;
pub use tool_change::{ToolChange, ToolChangeAnswer, ToolChangePlan, plan_tool_change};
