//! Best length and bound while the engine works: one line on standard error, when that is a terminal.

use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};
use traverse_geometry::Finding;
use traverse_layout_sequencing::{LayoutAnswer, order_sections};
use traverse_proto::OrderQuestion;
use traverse_server::Engines;
use traverse_solve::{Budget, Observer};

/// The line is written no more often than this.
const PACE: Duration = Duration::from_millis(100);

/// The engines of this product, seen at work.
pub(crate) struct WatchedEngines;

/// Whether there is a terminal to write the line to.
pub(crate) fn has_terminal() -> bool {
    std::io::stderr().is_terminal()
}

impl Engines for WatchedEngines {
    fn order_sections(
        &self,
        question: &OrderQuestion,
        budget: &Budget,
        observer: &mut dyn Observer,
    ) -> Result<LayoutAnswer, Vec<Finding>> {
        let mut out = std::io::stderr();
        let mut line = LiveLine::new(observer, &mut out);
        let answer = order_sections(&question.layout, &question.options, budget, &mut line);
        line.clear();
        answer
    }
}

/// Passes on what it hears and writes it over the same line.
struct LiveLine<'a> {
    next: &'a mut dyn Observer,
    out: &'a mut dyn Write,
    begun: Instant,
    written: Option<Instant>,
    cost: Option<f64>,
    bound: Option<f64>,
}

impl<'a> LiveLine<'a> {
    fn new(next: &'a mut dyn Observer, out: &'a mut dyn Write) -> Self {
        Self { next, out, begun: Instant::now(), written: None, cost: None, bound: None }
    }

    fn write(&mut self) {
        let now = Instant::now();
        if self.written.is_some_and(|written| now - written < PACE) {
            return;
        }
        self.written = Some(now);
        let text = line(now - self.begun, self.cost, self.bound);
        // Whoever closed it does not want to know.
        write!(self.out, "\r{text:<78}").and_then(|()| self.out.flush()).ok();
    }

    fn clear(&mut self) {
        if self.written.is_some() {
            write!(self.out, "\r{:<78}\r", "").and_then(|()| self.out.flush()).ok();
        }
    }
}

fn line(after: Duration, cost: Option<f64>, bound: Option<f64>) -> String {
    let millimetres = |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.3} mm"));
    let gap = match (cost, bound) {
        (Some(cost), Some(bound)) if cost > 0.0 => {
            format!(", within {:.2} %", 100.0 * ((cost - bound) / cost).max(0.0))
        }
        _ => String::new(),
    };
    format!("{:6.1} s  best {}, bound {}{gap}", after.as_secs_f64(), millimetres(cost), millimetres(bound))
}

impl Observer for LiveLine<'_> {
    fn better_cost(&mut self, cost: f64) {
        self.next.better_cost(cost);
        self.cost = Some(cost);
        self.write();
    }

    fn better_bound(&mut self, lower_bound: f64) {
        self.next.better_bound(lower_bound);
        self.bound = Some(lower_bound);
        self.write();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_solve::Trace;

    #[test]
    fn what_is_heard_is_passed_on_and_the_line_is_cleared() {
        let (mut trace, mut out) = (Trace::default(), Vec::new());
        let mut line = LiveLine::new(&mut trace, &mut out);
        line.better_bound(90.0);
        line.better_cost(100.0);
        line.clear();
        let text = String::from_utf8(out).unwrap();
        assert!(text.contains("best –, bound 90.000 mm") && text.ends_with('\r'), "{text:?}");
        assert_eq!((trace.costs, trace.bounds), (vec![100.0], vec![90.0]));
    }

    #[test]
    fn the_line_says_how_far_apart_both_are() {
        let text = line(Duration::from_millis(1500), Some(100.0), Some(90.0));
        assert_eq!(text, "   1.5 s  best 100.000 mm, bound 90.000 mm, within 10.00 %");
    }
}
