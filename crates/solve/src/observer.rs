//! Whom an engine tells about its progress while it works.

/// Hears of every better plan and every better bound. Called from the engine's thread: return quickly.
pub trait Observer {
    /// A plan of this cost was found, cheaper than all before.
    fn better_cost(&mut self, cost: f64);
    /// No plan costs less than this; higher than all bounds before.
    fn better_bound(&mut self, lower_bound: f64);
}

/// Hears nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Observer for Silent {
    fn better_cost(&mut self, _cost: f64) {}
    fn better_bound(&mut self, _lower_bound: f64) {}
}

/// Keeps everything that it hears, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Costs of ever better plans.
    pub costs: Vec<f64>,
    /// Ever better bounds.
    pub bounds: Vec<f64>,
}

impl Observer for Trace {
    fn better_cost(&mut self, cost: f64) {
        self.costs.push(cost);
    }

    fn better_bound(&mut self, lower_bound: f64) {
        self.bounds.push(lower_bound);
    }
}
