//! The one entry: validates, bounds, orders by the method asked for, places exactly, answers.
//!
//! First the order as it was sent is placed, or one that is allowed: whatever ends the time later, there is a layout. The
//! best method climbs: bounds that need no search; the order by neighbours, which is proven when the layout it
//! gives is as short as its bound; a round of local search on the true length; where a table of completions fits, or
//! few sections slide freely, the search that proves; local search until the budget ends.

use crate::allowed_order::allowed_order;
use crate::answer::{Ending, LayoutAnswer, LayoutPlan};
use crate::best_first::{Searched, search};
use crate::certificate::BoundCertificate;
use crate::chain_bound::chain_bound;
use crate::completion::{Completion, NO_COMPLETION};
use crate::findings::layout_findings;
use crate::height_bound::height_bound;
use crate::improvement::Improvement;
use crate::instance::Instance;
use crate::kept_start::improve_kept;
use crate::layout::{bounding_box_length_mm, contacts_by, layout_length_mm, published_length_mm};
use crate::options::{Algorithm, ContactList, EffectModel, OrderOptions};
use crate::places::Places;
use crate::placing::Placing;
use crate::pose_choice::choose_poses;
use crate::pose_prices::order_at_prices;
use crate::progress::Progress;
use crate::published_order::order_as_published;
use crate::relaxation::{Relaxed, relax};
use traverse_geometry::{Finding, PlacedSection, SectionLayout, SlideRule};
use traverse_solve::{Budget, Interrupt, Observer};

/// What of the budget all offsets may take; beyond it each is computed when it is asked for.
const OFFSETS_SHARE: f64 = 0.4;
/// What of what is left the order by neighbours may take.
const RELAXATION_SHARE: f64 = 0.4;
/// The same where joins are computed when asked for: there it is most of what can be done.
const LAZY_RELAXATION_SHARE: f64 = 0.7;
/// What of what is left prices of poses may take.
const PRICES_SHARE: f64 = 0.2;
/// What of it the choice of sections whose chain bounds best, the table of completions, and the search that proves may
/// take in turn.
const CHAIN_SHARE: f64 = 0.1;
const TABLE_SHARE: f64 = 0.4;
const PROOF_SHARE: f64 = 0.7;

/// What of what is left then local search may take that keeps the order of sections that slide freely.
const KEPT_SHARE: f64 = 0.3;

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
/// the answer has no plan; nor has it when it ends before one order is placed, or when it is cancelled: nobody waits then.
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
    let mut instance = match Instance::of_envelopes(layout, &preparation) {
        Ok(instance) => instance,
        Err(interrupt) => return Ok(unknown(interrupt)),
    };
    let start = match start(layout, options, &instance, &preparation) {
        Ok(start) => start,
        Err(interrupt) => return Ok(unknown(interrupt)),
    };
    let share = preparation.share(OFFSETS_SHARE, 0);
    let prepared = instance.work_out_offsets(options.threads, &share).or_else(|_| preparation.check(0));
    let mut order = Order {
        layout,
        instance: &instance,
        options,
        budget,
        preparation: &preparation,
        progress: Progress::new(&instance, options.gap_limit, observer),
        places: Places::default(),
        certificate: BoundCertificate::None,
        certified: 0,
    };
    if let Some((items, placing)) = start {
        order.offer(&items, &placing);
    }
    let ending = prepared.and_then(|()| order.run()).unwrap_or_else(Ending::Interrupted);
    Ok(order.answer(ending))
}

/// The order that was sent, otherwise the sections as they were sent or as near to that as is allowed, placed.
fn start(
    layout: &SectionLayout,
    options: &OrderOptions,
    instance: &Instance,
    budget: &Budget,
) -> Result<Option<(Vec<usize>, Placing)>, Interrupt> {
    let items: Option<Vec<usize>> = match &options.initial_order {
        Some(order) => {
            let items: Vec<usize> =
                order.iter().map(|placed| instance.item_of(placed.section, placed.pose)).collect();
            let kinds: Vec<usize> = items.iter().map(|&item| instance.items[item].kind).collect();
            instance.is_allowed(&kinds).then_some(items)
        }
        // What a method of 2009 finds is its own.
        None if options.algorithm.is_published() || options.effect_model == EffectModel::Published => None,
        None => {
            let kinds = (0..instance.sections()).map(|section| instance.kind_of(section));
            let copies = kinds.zip(&layout.sections);
            let sent: Vec<usize> = copies
                .flat_map(|(kind, section)| std::iter::repeat_n(kind, section.quantity as usize))
                .collect();
            let allowed =
                if instance.is_allowed(&sent) { Some(sent) } else { allowed_order(instance, &sent) };
            allowed.map(|kinds| kinds.iter().map(|&kind| instance.kinds[kind].items.start).collect())
        }
    };
    let Some(items) = items else { return Ok(None) };
    let placing = Placing::of(instance, &items, budget)?;
    Ok(Some((items, placing)))
}

struct Order<'a> {
    layout: &'a SectionLayout,
    instance: &'a Instance,
    options: &'a OrderOptions,
    budget: &'a Budget,
    /// The same without a limit of iterations.
    preparation: &'a Budget,
    progress: Progress<'a>,
    /// Where the best layout stands, unless a search found it that keeps no places.
    places: Places,
    certificate: BoundCertificate,
    certified: i64,
}

impl Order<'_> {
    fn run(&mut self) -> Result<Ending, Interrupt> {
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
        // With precedence among many copies the order by neighbours does not know it.
        let order = relaxed.order.and_then(|order| {
            if self.instance.is_allowed(&order) { Some(order) } else { allowed_order(self.instance, &order) }
        });
        if let Some(order) = order {
            let items = choose_poses(self.instance, &order, self.preparation)?;
            self.place_and_offer(&items)?;
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
            Ok(Some(items)) => self.place_and_offer(&items)?,
            Ok(None) => {}
            // Its share is used up; what follows has its own.
            Err(_) => self.budget.check(self.progress.iterations())?,
        }
        Ok(())
    }

    fn place_and_offer(&mut self, items: &[usize]) -> Result<(), Interrupt> {
        let placing = Placing::of(self.instance, items, self.preparation)?;
        self.offer(items, &placing);
        Ok(())
    }

    fn offer(&mut self, items: &[usize], placing: &Placing) {
        if placing.length() < self.progress.upper() {
            self.progress.offer(items, placing.length());
            self.places.keep(items, &placing.x);
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
        let relaxed = relax(self.instance, seed, threads, &mut self.progress, &budget, self.preparation)?;
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
        improvement.round(&mut self.progress, &mut self.places, self.budget)?;
        if self.progress.is_close_enough() {
            return Ok(self.close_ending());
        }
        if let Some(ending) = self.prove()? {
            return Ok(ending);
        }
        self.improve_kept()?;
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
            idle = if improvement.round(&mut self.progress, &mut self.places, self.budget)? {
                0
            } else {
                idle + 1
            };
        }
    }

    /// Where sections slide freely: what an order is good for while it is kept is a start.
    fn improve_kept(&mut self) -> Result<(), Interrupt> {
        let instance = self.instance;
        let Some((items, _)) = self.progress.best() else { return Ok(()) };
        if instance.rule == SlideRule::KeepOrder || !instance.has_all_offsets() {
            return Ok(());
        }
        let items = items.to_vec();
        let share = self.budget.share(KEPT_SHARE, self.progress.iterations());
        match improve_kept(instance, &items, self.options.seed.part(3), &share) {
            Ok((items, iterations)) => {
                self.progress.add_iterations(iterations);
                self.place_and_offer(&items)
            }
            // Its share is used up; what follows has its own.
            Err(_) => self.budget.check(self.progress.iterations()),
        }
    }

    /// The search that proves, where the layout is for it. An ending when everything is decided.
    fn prove(&mut self) -> Result<Option<Ending>, Interrupt> {
        let instance = self.instance;
        if !instance.has_all_offsets() {
            return Ok(None);
        }
        let tables = self.tables();
        if self.progress.is_close_enough() {
            return Ok(Some(self.close_ending()));
        }
        if tables.iter().any(|table| table.bound(instance) >= NO_COMPLETION) && self.progress.best().is_none()
        {
            return Ok(Some(Ending::ProvenInfeasible));
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

    /// Tables of completions, that of all kinds first, their bounds told. With joins that are forbidden, and where
    /// no table fits, chains that leave sections out are sought by themselves.
    fn tables(&mut self) -> Vec<Completion> {
        let instance = self.instance;
        let mut tables = vec![];
        let everything = vec![true; instance.kinds.len()];
        self.add_table(&everything, &mut tables);
        let has_parts = tables.iter().any(|table| table.longest_part(0).is_some());
        if has_parts || self.progress.is_close_enough() {
            return tables;
        }
        let share = self.budget.share(CHAIN_SHARE, self.progress.iterations());
        let chain = chain_bound(instance, self.options.seed, &mut self.progress, &share);
        if let Some(members) = chain.filter(|_| !tables.is_empty() && !self.progress.is_close_enough()) {
            self.add_table(&members, &mut tables);
        }
        tables
    }

    fn add_table(&mut self, members: &[bool], tables: &mut Vec<Completion>) {
        let instance = self.instance;
        let share = Budget { iterations: None, ..self.budget.share(TABLE_SHARE, 0) };
        let longest = self.progress.upper().min(instance.sum_of_reaches());
        let Ok(Some(table)) = Completion::of(instance, members, longest, &share) else { return };
        self.progress.count_coarsely(table.coarseness(instance));
        for bound in [Some(table.bound(instance)), table.longest_bound(instance)].into_iter().flatten() {
            // That nothing is allowed is no bound.
            if bound < NO_COMPLETION {
                self.progress.raise_bound(bound);
            }
        }
        tables.push(table);
    }

    fn close_ending(&self) -> Ending {
        if self.progress.is_proven() { Ending::ProvenOptimal } else { Ending::GapReached }
    }

    fn answer(self, ending: Ending) -> LayoutAnswer {
        let grid = self.instance.grid;
        let plan = self.progress.best().and_then(|(items, _)| self.plan(items).ok());
        let length_mm = plan.as_ref().map_or(f64::INFINITY, |plan| plan.length_mm);
        let proven = self.progress.is_proven();
        // A proof may miss what bounds miss that count in a coarser unit: the bound says so.
        let has_met = self.progress.bound() == self.progress.upper();
        let bound = if has_met { length_mm } else { grid.mm(self.progress.bound()).min(length_mm) };
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

    /// What is left to say of the best order once the search is over. Only a cancel ends it: what it costs is in
    /// proportion to the layout.
    fn plan(&self, items: &[usize]) -> Result<LayoutPlan, Interrupt> {
        let budget = Budget { deadline: None, iterations: None, cancel: self.budget.cancel.clone() };
        budget.check(0)?;
        let placed;
        let left_edges = match self.places.of(items) {
            Some(left_edges) => left_edges,
            None => {
                placed = Placing::of(self.instance, items, &budget)?;
                &placed.x
            }
        };
        let mut order = self.instance.named(items, left_edges);
        if let Some(given) = self.options.initial_order.as_ref().filter(|given| is_same_order(given, &order))
        {
            // The order that was sent keeps the names of its copies.
            order = given
                .iter()
                .zip(&order)
                .map(|(given, placed)| PlacedSection { x_mm: placed.x_mm, ..*given })
                .collect();
        }
        let profile = |at: usize| &self.instance.items[items[at]].profile;
        Ok(LayoutPlan {
            length_mm: layout_length_mm(self.layout, &order),
            bounding_box_length_mm: bounding_box_length_mm(self.layout, &order),
            published_length_mm: published_length_mm(self.layout, &order, &budget)?,
            contacts: match self.options.contacts {
                ContactList::Listed => contacts_by(self.layout, &order, profile, &budget)?,
                ContactList::Omitted => vec![],
            },
            order,
        })
    }
}

/// Whether both name equal things at every place. Sections that are equal may stand for each other: then not.
fn is_same_order(given: &[PlacedSection], order: &[PlacedSection]) -> bool {
    given.len() == order.len()
        && given.iter().zip(order).all(|(a, b)| (a.section, a.pose) == (b.section, b.pose))
}
