//! The one entry: validates, bounds, orders by the method asked for, places exactly, answers.
//!
//! The best method climbs: bounds that need no search; the order by neighbours, which is proven when the layout it
//! gives is as short as its bound; a round of local search on the true length; where a table of completions fits, or
//! few sections slide freely, the search that proves; local search until the budget ends.

use crate::answer::{Ending, LayoutAnswer, LayoutPlan};
use crate::best_first::{Searched, search};
use crate::certificate::BoundCertificate;
use crate::chain_bound::chain_bound;
use crate::completion::{Completion, NO_COMPLETION};
use crate::findings::layout_findings;
use crate::height_bound::height_bound;
use crate::improvement::Improvement;
use crate::instance::{Instance, Kind};
use crate::layout::{bounding_box_length_mm, contacts_unless, layout_length_mm, published_length_mm};
use crate::options::{Algorithm, EffectModel, OrderOptions};
use crate::placing::Placing;
use crate::pose_choice::choose_poses;
use crate::pose_prices::order_at_prices;
use crate::progress::Progress;
use crate::published_order::order_as_published;
use crate::relaxation::{Relaxed, relax};
use traverse_geometry::{Finding, PlacedSection, SectionLayout};
use traverse_solve::{Budget, Interrupt, Observer};

/// What of the budget the order by neighbours may take.
const RELAXATION_SHARE: f64 = 0.4;
/// The same where joins are computed when asked for: there it is most of what can be done.
const LAZY_RELAXATION_SHARE: f64 = 0.7;
/// What of what is left prices of poses may take.
const PRICES_SHARE: f64 = 0.2;
/// What of it the choice of sections whose chain bounds best, the table of completions, and the search that proves may
/// take in turn.
const CHAIN_SHARE: f64 = 0.1;
const TABLE_SHARE: f64 = 0.4;
const PROOF_SHARE: f64 = 0.6;

/// Rounds of local search without a better layout after which it rests, where nothing limits it.
const PATIENCE: u32 = 4;

/// Orders the sections of a layout, and says how good the order is known to be.
///
/// Iterations are kicks and nodes of searches for the order by neighbours, layouts tried, and beginnings of layouts
/// searched. With one thread the same question, seed and iteration limit give the same answer; a time limit ends
/// elsewhere every time.
///
/// # Errors
/// Everything that is wrong with the question, as [`layout_findings`] says. When the budget ends before that is known
/// the answer has no plan; neither when it was cancelled.
pub fn order_sections(
    layout: &SectionLayout,
    options: &OrderOptions,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> Result<LayoutAnswer, Vec<Finding>> {
    let unknown = |interrupt: Interrupt| LayoutAnswer {
        plan: None,
        lower_bound_mm: 0.0,
        certificate: BoundCertificate::None,
        certified_lower_bound_mm: 0.0,
        ending: Ending::Interrupted(interrupt),
        iterations: 0,
        algorithm: options.algorithm.name(),
    };
    // Preparation is no iteration: only time and cancel end it.
    let preparation = Budget { iterations: None, ..budget.clone() };
    match layout_findings(layout, options, &preparation) {
        Ok(findings) if findings.is_empty() => {}
        Ok(findings) => return Err(findings),
        Err(interrupt) => return Ok(unknown(interrupt)),
    }
    let instance = match Instance::of(layout, options.threads, &preparation) {
        Ok(instance) => instance,
        Err(interrupt) => return Ok(unknown(interrupt)),
    };
    let mut order = Order {
        layout,
        instance: &instance,
        options,
        budget,
        preparation: &preparation,
        progress: Progress::new(&instance, options.gap_limit, observer),
        certificate: BoundCertificate::None,
        certified: 0,
    };
    let ending = order.run().unwrap_or_else(Ending::Interrupted);
    Ok(order.answer(ending))
}

struct Order<'a> {
    layout: &'a SectionLayout,
    instance: &'a Instance,
    options: &'a OrderOptions,
    budget: &'a Budget,
    /// The same without a limit of iterations.
    preparation: &'a Budget,
    progress: Progress<'a>,
    certificate: BoundCertificate,
    certified: i64,
}

impl Order<'_> {
    fn run(&mut self) -> Result<Ending, Interrupt> {
        self.offer_given();
        let (bound, certificate) = height_bound(self.instance, self.preparation)?;
        self.certified = bound;
        self.certificate = certificate;
        self.progress.raise_bound(bound);
        if self.options.algorithm.is_published() {
            self.order_as_published()?;
        }
        let relaxed = self.relax()?;
        if relaxed.infeasible {
            return Ok(Ending::ProvenInfeasible);
        }
        let decided = match self.options.algorithm {
            Algorithm::GivenOrder => true,
            algorithm if algorithm.is_published() => true,
            _ if self.options.effect_model == EffectModel::Published => {
                self.order_as_published()?;
                true
            }
            _ => false,
        };
        if decided {
            return Ok(if self.progress.is_proven() { Ending::ProvenOptimal } else { Ending::Exhausted });
        }
        if let Some(order) = relaxed.order.filter(|order| self.instance.is_allowed(order)) {
            let items = choose_poses(self.instance, &order, self.preparation)?;
            self.progress.offer(&items, Placing::of(self.instance, &items).length());
        }
        self.order_at_prices()?;
        self.search()
    }

    /// Where sections have poses to choose from: a better bound, and perhaps a better order.
    fn order_at_prices(&mut self) -> Result<(), Interrupt> {
        if self.progress.is_close_enough() {
            return Ok(());
        }
        let budget = self.budget.share(PRICES_SHARE, self.progress.iterations());
        let seed = self.options.seed.part(2);
        match order_at_prices(self.instance, seed, &mut self.progress, &budget) {
            Ok(Some(items)) => self.progress.offer(&items, Placing::of(self.instance, &items).length()),
            Ok(None) => {}
            // Its share is used up; what follows has its own.
            Err(_) => self.budget.check(self.progress.iterations())?,
        }
        Ok(())
    }

    /// The order that was sent, or the sections as they were sent, where that is allowed.
    fn offer_given(&mut self) {
        let instance = self.instance;
        let items: Vec<usize> = match &self.options.initial_order {
            Some(order) => order.iter().map(|placed| instance.item_of(placed.section, placed.pose)).collect(),
            // What a method of 2009 finds is its own.
            None if self.options.algorithm.is_published()
                || self.options.effect_model == EffectModel::Published =>
            {
                return;
            }
            None => {
                let sections = (0..instance.sections()).map(|section| instance.kind_of(section));
                let copies = sections.zip(&self.layout.sections);
                copies
                    .flat_map(|(kind, section)| {
                        std::iter::repeat_n(instance.kinds[kind].items.start, section.quantity as usize)
                    })
                    .collect()
            }
        };
        let kinds: Vec<usize> = items.iter().map(|&item| instance.items[item].kind).collect();
        if instance.is_allowed(&kinds) {
            self.progress.offer(&items, Placing::of(instance, &items).length());
        }
    }

    fn order_as_published(&mut self) -> Result<(), Interrupt> {
        let (algorithm, model) = (self.options.algorithm, self.options.effect_model);
        let budget = self.budget.share(1.0 - RELAXATION_SHARE, self.progress.iterations());
        let done = order_as_published(
            self.layout,
            self.instance,
            algorithm,
            model,
            self.options.seed,
            &mut self.progress,
            &budget,
        );
        // Its share is used up; the bound has its own.
        done.or_else(|_| self.budget.check(self.progress.iterations()))
    }

    fn relax(&mut self) -> Result<Relaxed, Interrupt> {
        let part = if self.instance.has_all_offsets() { RELAXATION_SHARE } else { LAZY_RELAXATION_SHARE };
        let budget = self.budget.share(part, self.progress.iterations());
        let (seed, threads) = (self.options.seed, self.options.threads);
        let relaxed = relax(self.instance, seed, threads, &mut self.progress, &budget)?;
        if relaxed.certified > self.certified {
            self.certified = relaxed.certified;
            self.certificate = relaxed.certificate.clone();
        }
        Ok(relaxed)
    }

    fn search(&mut self) -> Result<Ending, Interrupt> {
        let (instance, seed) = (self.instance, self.options.seed.part(1));
        if self.progress.is_close_enough() {
            return Ok(self.close_ending());
        }
        let mut improvement = Improvement::new(instance, seed, self.preparation)?;
        improvement.round(&mut self.progress, self.budget)?;
        if self.progress.is_close_enough() {
            return Ok(self.close_ending());
        }
        if let Some(ending) = self.prove()? {
            return Ok(ending);
        }
        let limited = self.budget.deadline.is_some() || self.budget.iterations.is_some();
        let mut idle = 0;
        loop {
            self.budget.check(self.progress.iterations())?;
            if self.progress.is_close_enough() {
                return Ok(self.close_ending());
            }
            if self.progress.best().is_none() || (!limited && idle >= PATIENCE) {
                return Ok(Ending::Exhausted);
            }
            idle = if improvement.round(&mut self.progress, self.budget)? { 0 } else { idle + 1 };
        }
    }

    /// The search that proves, where the layout is for it. An ending when everything is decided.
    fn prove(&mut self) -> Result<Option<Ending>, Interrupt> {
        let instance = self.instance;
        if !instance.has_all_offsets() {
            return Ok(None);
        }
        let share = self.budget.share(CHAIN_SHARE, self.progress.iterations());
        let chain = chain_bound(instance, self.options.seed, &mut self.progress, &share);
        if self.progress.is_close_enough() {
            return Ok(Some(self.close_ending()));
        }
        let share = Budget { iterations: None, ..self.budget.share(TABLE_SHARE, 0) };
        let boxes = |kind: &Kind| instance.items[kind.items.start].reach * kind.copies.len() as i64;
        let longest = self.progress.upper().min(instance.kinds.iter().map(boxes).sum());
        let everything = vec![true; instance.kinds.len()];
        let mut tables = vec![];
        for members in [Some(everything), chain].into_iter().flatten() {
            let Ok(Some(table)) = Completion::of(instance, &members, longest, &share) else { break };
            let bound = table.bound(instance);
            self.progress.count_coarsely(table.coarseness(instance));
            if bound >= NO_COMPLETION && self.progress.best().is_none() {
                return Ok(Some(Ending::ProvenInfeasible));
            }
            self.progress.raise_bound(bound);
            if self.progress.is_close_enough() {
                return Ok(Some(self.close_ending()));
            }
            tables.push(table);
        }
        let done = self.progress.iterations();
        let mut share = self.budget.share(PROOF_SHARE, done);
        // The search counts on from what was done.
        share.iterations = share.iterations.map(|limit| limit.saturating_add(done));
        let searched = search(instance, &tables, &mut self.progress, &share);
        Ok(match searched {
            Ok(Searched::Everything) if self.progress.best().is_none() => Some(Ending::ProvenInfeasible),
            Ok(Searched::Everything) => Some(Ending::ProvenOptimal),
            Ok(Searched::Part) | Err(_) => None,
        })
    }

    fn close_ending(&self) -> Ending {
        if self.progress.is_proven() { Ending::ProvenOptimal } else { Ending::GapReached }
    }

    fn answer(self, ending: Ending) -> LayoutAnswer {
        let grid = self.instance.grid;
        let plan = self.progress.best().and_then(|(items, _)| self.plan(items));
        let length_mm = plan.as_ref().map_or(f64::INFINITY, |plan| plan.length_mm);
        let proven = self.progress.is_proven();
        let bound = if proven { length_mm } else { grid.mm(self.progress.bound()).min(length_mm) };
        let infeasible = ending == Ending::ProvenInfeasible;
        LayoutAnswer {
            plan,
            lower_bound_mm: if infeasible { 0.0 } else { bound },
            certified_lower_bound_mm: if infeasible { 0.0 } else { grid.mm(self.certified).min(bound) },
            certificate: if infeasible { BoundCertificate::None } else { self.certificate },
            ending: if proven && !infeasible { Ending::ProvenOptimal } else { ending },
            iterations: self.progress.iterations(),
            algorithm: self.options.algorithm.name(),
        }
    }

    /// None when cancelled: what it says takes time, and nobody waits for it.
    fn plan(&self, items: &[usize]) -> Option<LayoutPlan> {
        let cancel = &self.budget.cancel;
        if cancel.is_cancelled() {
            return None;
        }
        let placing = Placing::of(self.instance, items);
        let mut order = self.instance.named(items, &placing.x);
        if let Some(given) = self.options.initial_order.as_ref().filter(|given| is_same_order(given, &order))
        {
            // The order that was sent keeps the names of its copies.
            order = given
                .iter()
                .zip(&order)
                .map(|(given, placed)| PlacedSection { x_mm: placed.x_mm, ..*given })
                .collect();
        }
        Some(LayoutPlan {
            contacts: contacts_unless(self.layout, &order, cancel)?,
            length_mm: layout_length_mm(self.layout, &order),
            bounding_box_length_mm: bounding_box_length_mm(self.layout, &order),
            published_length_mm: published_length_mm(self.layout, &order),
            order,
        })
    }
}

/// Whether both name equal things at every place. Sections that are equal may stand for each other: then not.
fn is_same_order(given: &[PlacedSection], order: &[PlacedSection]) -> bool {
    given.len() == order.len()
        && given.iter().zip(order).all(|(a, b)| (a.section, a.pose) == (b.section, b.pose))
}
