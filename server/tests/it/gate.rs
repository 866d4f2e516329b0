//! Engines that wait until they are let through or their budget ends, and say so.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};
use traverse_geometry::Scene;
use traverse_planner::{Answer, PreparedScene, RapidMove, Refusal, Stats, plan_rapid_move};
use traverse_server::Engines;
use traverse_solve::{Budget, Interrupt, Silent};

/// The engines' side.
pub(crate) struct Gated {
    open: Arc<AtomicBool>,
    begun: UnboundedSender<()>,
    ended: UnboundedSender<Option<Interrupt>>,
}

/// The test's side.
pub(crate) struct Gate {
    open: Arc<AtomicBool>,
    begun: UnboundedReceiver<()>,
    ended: UnboundedReceiver<Option<Interrupt>>,
}

pub(crate) fn gated() -> (Gated, Gate) {
    let open = Arc::new(AtomicBool::new(false));
    let (begun, has_begun) = unbounded_channel();
    let (ended, has_ended) = unbounded_channel();
    (Gated { open: Arc::clone(&open), begun, ended }, Gate { open, begun: has_begun, ended: has_ended })
}

impl Gate {
    /// Lets everybody through from now on.
    pub(crate) fn open(&self) {
        self.open.store(true, Ordering::Relaxed);
    }

    /// Ends when one more engine runs.
    pub(crate) async fn begun(&mut self) {
        let begun = tokio::time::timeout(super::running::HANG, self.begun.recv()).await;
        begun.expect("an engine begins").expect("there are engines");
    }

    /// Ends when one more engine has stopped; by what, unless it was let through.
    pub(crate) async fn ended(&mut self) -> Option<Interrupt> {
        let ended = tokio::time::timeout(super::running::HANG, self.ended.recv()).await;
        ended.expect("an engine ends").expect("there are engines")
    }

    /// Whether an engine has begun that nobody has asked about.
    pub(crate) fn has_begun(&mut self) -> bool {
        self.begun.try_recv().is_ok()
    }
}

impl Gated {
    /// Waits at the gate.
    fn pass(&self, budget: &Budget) -> Result<(), Vec<Refusal>> {
        self.begun.send(()).ok();
        while !self.open.load(Ordering::Relaxed) {
            if let Err(interrupt) = budget.check(0) {
                self.ended.send(Some(interrupt)).ok();
                return Err(vec![Refusal::Interrupted { interrupt, lower_bound: 20.0 }]);
            }
            std::thread::park_timeout(Duration::from_millis(1));
        }
        self.ended.send(None).ok();
        Ok(())
    }
}

impl Engines for Gated {
    fn plan_rapid_move(
        &self,
        scene: &Scene,
        query: &RapidMove,
        budget: &Budget,
    ) -> Result<(Answer, Stats), Vec<Refusal>> {
        self.pass(budget)?;
        plan_rapid_move(scene, query, budget, &mut Silent)
    }

    fn plan_in_scene(
        &self,
        scene: &mut PreparedScene,
        query: &RapidMove,
        budget: &Budget,
    ) -> Result<(Answer, Stats), Vec<Refusal>> {
        self.pass(budget)?;
        scene.plan(query, budget, &mut Silent)
    }
}
