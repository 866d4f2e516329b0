//! Runs blocks one after another, as far as positions and modes go, and tells which of them move rapidly.
//!
//! Words act in the order of RS274: feed, tool, modes and offsets before motion, wherever they stand in the block.
//! What can't be known is not guessed.

use crate::block::{Block, Fault, Kind, Word};
use crate::codes::{Code, Distance, Distortion, Motion, Once, Retract};
use crate::modal::{Feed, Lost, Modal, Tool};
use crate::options::ReadOptions;
use crate::reason::Reason;
use crate::survey::Survey;

/// What a block does, as far as rapid moves are concerned.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Deed {
    /// Nothing at all: blank, comment, block number.
    Idle,
    /// Something else.
    Other,
    /// A rapid move, or one between two holes of a canned cycle.
    Rapid(Rapid),
    /// A move, but whether it is a rapid one, or where it leads, is not known.
    Vague(Reason),
    /// The line was not understood.
    Fault(Fault),
    /// Behind the `%` that ends the program.
    Behind,
}

/// A rapid move of one block.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rapid {
    /// X, Y, Z before and after; X and Y in the drawing.
    pub(crate) from: [Option<f64>; 3],
    pub(crate) to: [Option<f64>; 3],
    /// Whether X or Y, and whether Z stands in the block.
    pub(crate) along: bool,
    pub(crate) up_or_down: bool,
    pub(crate) role: RapidRole,
}

/// What else the block is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RapidRole {
    /// N, G0 and axis words only.
    Plain,
    /// Modes change as well: G90, G54, F and the like.
    WithModes,
    /// It also does what must not run at another place: M, S, T.
    WithOthers(u8),
    /// Another axis moves along.
    WithAxis(u8),
    /// From hole to hole in a canned cycle.
    Cycle,
    /// The operator may skip it.
    Skippable,
}

pub(crate) struct Interpreter<'a> {
    options: &'a ReadOptions,
    survey: &'a Survey,
    pub(crate) modal: Modal,
    tape_marks: u32,
    /// Turning axes that do not stand at 0: A, B, C.
    turned: [bool; 3],
}

impl<'a> Interpreter<'a> {
    pub(crate) fn new(options: &'a ReadOptions, survey: &'a Survey) -> Self {
        let start = options.start.map(|start| [start.x, start.y]);
        let modal = Modal::at_start(options.unit, options.offsets.origin(0), start);
        Self { options, survey, modal, tape_marks: 0, turned: [false; 3] }
    }

    /// Runs a block that stands on `line`, its text at `start` in the program.
    pub(crate) fn run(&mut self, block: &Block, line: u32, start: usize) -> Deed {
        if self.tape_marks > 1 || (self.tape_marks == 1 && !self.survey.has_tape_mark) {
            return Deed::Behind;
        }
        if self.survey.jumps && block.word(b'N').is_some() {
            self.forget(line, Lost::Call);
        }
        match block.kind {
            Kind::TapeMark => {
                self.tape_marks += 1;
                Deed::Other
            }
            // The first number names the program that is read; any other begins one that is called.
            Kind::ProgramNumber => {
                if self.modal.lost[0].1 != Lost::Start {
                    self.forget(line, Lost::Call);
                }
                Deed::Other
            }
            Kind::Control => {
                self.forget(line, Lost::Call);
                Deed::Other
            }
            Kind::Assignment { of_offsets } => {
                if of_offsets {
                    self.distort(Distortion::OffsetsSet, line);
                }
                Deed::Other
            }
            Kind::Fault(fault) => self.fault(line, fault),
            Kind::Words if block.is_idle() => Deed::Idle,
            Kind::Words if block.skippable => {
                let skipped = self.modal.clone();
                let deed = self.words(block, line, start);
                self.modal.merge(&skipped, line);
                match deed {
                    Deed::Rapid(rapid) => Deed::Rapid(Rapid { role: RapidRole::Skippable, ..rapid }),
                    other => other,
                }
            }
            Kind::Words => self.words(block, line, start),
        }
    }

    fn fault(&mut self, line: u32, fault: Fault) -> Deed {
        self.forget(line, Lost::Fault);
        Deed::Fault(fault)
    }

    fn forget(&mut self, line: u32, lost: Lost) {
        self.modal.forget(line, lost, self.survey.mixes_units, self.survey.mixes_offsets);
    }

    fn distort(&mut self, distortion: Distortion, line: u32) {
        self.modal.distortions[distortion as usize] = line.max(1);
    }

    /// Heights count from elsewhere, or otherwise, once a distortion that may hold for Z begins or ends.
    fn shift_heights(&mut self, distortion: Distortion, line: u32) {
        if matches!(
            distortion,
            Distortion::Shift | Distortion::Scaling | Distortion::Mirror | Distortion::Rotation
        ) {
            self.modal.lose(2, line, Lost::Length);
        }
    }

    fn words(&mut self, block: &Block, line: u32, start: usize) -> Deed {
        let mut read = Read::default();
        for word in &block.words {
            if let Err(fault) = self.word(word, line, start, &mut read) {
                return self.fault(line, fault);
            }
        }
        if let Some(fault) = self.options.is_fanuc(self.survey).then(|| no_point(block)).flatten() {
            return self.fault(line, fault);
        }
        self.tools(block, line, &mut read);
        let deed = self.moves(block, line, &read);
        if read.forgets {
            self.forget(line, Lost::Call);
        }
        deed
    }

    fn word(&mut self, word: &Word, line: u32, start: usize, read: &mut Read) -> Result<(), Fault> {
        match word.letter {
            b'G' => {
                let Some(number) = word.decimal() else {
                    read.forgets = true;
                    return Ok(());
                };
                // Hundredths (G54.1 P, G38.25) do not matter to any code that is known.
                let tenths = (number.value() * 10.0 + 1e-6).floor();
                if !(0.0..1e6).contains(&tenths) {
                    return Err(Fault::NoCode);
                }
                self.code(Code::of(tenths as u32), line, read)
            }
            b'F' => {
                let place = |offset: usize| u32::try_from(start + offset).ok();
                self.modal.feed = match (word.decimal(), place(word.number), place(word.span.end)) {
                    (Some(_), Some(start), Some(end)) => Feed::Stands { start, end, unit: None },
                    _ => Feed::Unknown,
                };
                read.feed = true;
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn code(&mut self, code: Code, line: u32, read: &mut Read) -> Result<(), Fault> {
        match code {
            Code::Motion(motion) => {
                // G80 stands beside G0 in the first line of many a program.
                let cancels = |motion| motion == Motion::None;
                match read.motion {
                    Some(stated) if stated != motion && !cancels(stated) && !cancels(motion) => {
                        return Err(Fault::CodesContradict);
                    }
                    Some(stated) if !cancels(stated) => {}
                    _ => read.motion = Some(motion),
                }
                return Ok(());
            }
            Code::Plane(plane) => self.modal.plane = Some(plane),
            Code::Unit(unit) => self.modal.unit = Some(unit),
            Code::Distance(distance) => {
                if read.distance.is_some_and(|stated| stated != distance) {
                    return Err(Fault::CodesContradict);
                }
                read.distance = Some(distance);
                self.modal.distance = Some(distance);
            }
            Code::Centers(centers) => self.modal.centers = Some(centers),
            Code::FeedMode(mode) => self.modal.feed_mode = Some(mode),
            Code::Offset(offset) => {
                let origin = offset.and_then(|offset| self.options.offsets.origin(offset));
                // Offsets that lie at the same X and Y may still count heights from elsewhere.
                if offset.is_none() || offset != self.modal.offset {
                    self.modal.lose(2, line, Lost::Length);
                }
                (self.modal.offset, self.modal.origin) = (offset, origin);
            }
            Code::Retract(retract) => self.modal.retract = Some(retract),
            Code::Length => self.modal.lose(2, line, Lost::Length),
            Code::Once(once) => read.once = Some(once),
            Code::Begins(distortion) => {
                self.distort(distortion, line);
                self.shift_heights(distortion, line);
                read.consumes = distortion != Distortion::Compensation && distortion != Distortion::Polar;
            }
            Code::Ends(distortion) => {
                self.modal.distortions[distortion as usize] = 0;
                self.shift_heights(distortion, line);
            }
            Code::Call => {
                read.forgets = true;
                read.consumes = true;
            }
            Code::Harmless => {}
            Code::HarmlessAlone => read.curve = true,
            Code::Unknown => read.unknown = true,
        }
        read.modes = true;
        Ok(())
    }

    /// M and T words, which act before the motion; but for those that call.
    fn tools(&mut self, block: &Block, line: u32, read: &mut Read) {
        if let Some(word) = block.word(b'T') {
            let number = word.decimal().and_then(crate::decimal::Decimal::whole);
            self.modal.selected = number.map_or(Tool::Unknown, Tool::Number);
        }
        for word in block.words.iter().filter(|word| word.letter == b'M') {
            match word.decimal().and_then(crate::decimal::Decimal::whole) {
                Some(6) => {
                    self.modal.tool = self.modal.selected;
                    self.modal.lose_position(line, Lost::ToolChange);
                }
                Some(3 | 4) => self.modal.spindle = Some(true),
                Some(5) => self.modal.spindle = Some(false),
                Some(2 | 30 | 72 | 73 | 97 | 98 | 99 | 198) | None => read.forgets = true,
                // Names the tool that is in the spindle already.
                Some(61) => {
                    let number = block.word(b'Q').and_then(Word::decimal);
                    let number = number.and_then(crate::decimal::Decimal::whole);
                    self.modal.tool = number.map_or(Tool::Unknown, Tool::Number);
                }
                Some(60) => self.modal.lose_position(line, Lost::ToolChange),
                Some(_) => {}
            }
        }
    }

    fn moves(&mut self, block: &Block, line: u32, read: &Read) -> Deed {
        if read.feed {
            // An F word counts in the unit of its own block, wherever that stands in it.
            if let Feed::Stands { unit, .. } = &mut self.modal.feed {
                *unit = self.modal.unit;
            }
        }
        if let Some(motion) = read.motion {
            self.modal.motion = Some(motion);
        }
        let axes = [b'X', b'Y', b'Z'].map(|letter| block.word(letter));
        let other = block.words.iter().map(|word| word.letter).find(|letter| b"ABCUVW".contains(letter));
        let moves = axes.iter().any(Option::is_some) || other.is_some();
        if let Some(once) = read.once.filter(|once| moves || matches!(once, Once::Home | Once::Setting)) {
            return self.once(once, axes, line);
        }
        if read.unknown {
            self.forget(line, Lost::UnknownMove);
            return Deed::Other;
        }
        if read.consumes && moves {
            // The words say where to turn, or where the origin is: nothing moves.
            return Deed::Other;
        }
        let from = self.modal.at;
        self.turning(block, line);
        let to = axes.into_iter().enumerate().map(|(axis, word)| match word {
            Some(word) => self.target(axis, word),
            None => Ok(from[axis]),
        });
        let to: Vec<Result<Option<f64>, Lost>> = to.collect();
        let deed = match self.modal.motion {
            _ if !moves => Deed::Other,
            None | Some(Motion::None) if axes[0].is_some() || axes[1].is_some() => {
                Deed::Vague(Reason::MotionUnknown)
            }
            Some(Motion::Rapid) => Deed::Rapid(self.rapid(block, from, &to, axes, other, read)),
            // Holes lie along another axis, and Y may be how deep they are.
            Some(Motion::Cycle(_)) if self.modal.plane != Some(17) => {
                self.modal.cycle_plane = None;
                self.modal.lose_position(line, Lost::UnknownMove);
                return Deed::Vague(Reason::CyclePlane);
            }
            Some(Motion::Cycle(_)) => {
                let mut rapid = self.rapid(block, from, &to, [axes[0], axes[1], None], other, read);
                rapid.role = RapidRole::Cycle;
                self.cycle(block, line, &to);
                self.blur(axes, line);
                return if rapid.along { Deed::Rapid(rapid) } else { Deed::Other };
            }
            _ => Deed::Other,
        };
        let vague = match self.modal.motion {
            None => Some(Lost::ModeUnknown),
            Some(Motion::None | Motion::Other) => Some(Lost::UnknownMove),
            _ => read.curve.then_some(Lost::UnknownMove),
        };
        for (axis, target) in to.into_iter().enumerate().filter(|(axis, _)| axes[*axis].is_some()) {
            match (target, vague) {
                (Ok(Some(target)), None) => self.modal.at[axis] = Some(target),
                (Err(lost), None) => self.modal.lose(axis, line, lost),
                (Ok(None), None) => {}
                (_, Some(lost)) => self.modal.lose(axis, line, lost),
            }
        }
        self.blur(axes, line);
        if other.is_some_and(|axis| b"UVW".contains(&axis)) {
            self.modal.lose_position(line, Lost::UnknownMove);
        }
        if moves && vague.is_some() && self.modal.motion == Some(Motion::Other) {
            self.modal.lose_position(line, Lost::UnknownMove);
        }
        deed
    }

    /// Turned, mirrored or beside the contour a word of one axis moves both.
    fn blur(&mut self, axes: [Option<&Word>; 3], line: u32) {
        let along = axes[0].is_some() || axes[1].is_some();
        if let Some((_, distortion)) = self.modal.distortion().filter(|_| along) {
            self.modal.lose(0, line, Lost::Distorted(distortion));
            self.modal.lose(1, line, Lost::Distorted(distortion));
        }
    }

    fn once(&mut self, once: Once, axes: [Option<&Word>; 3], line: u32) -> Deed {
        match once {
            Once::Stays => {}
            Once::Setting => self.distort(Distortion::OffsetsSet, line),
            Once::Home | Once::Machine => {
                let all = axes.iter().all(Option::is_none);
                for axis in (0..3).filter(|axis| all || axes[*axis].is_some()) {
                    self.modal.lose(axis, line, Lost::MachinePlace);
                }
            }
        }
        Deed::Other
    }

    /// Where an axis word leads; X and Y in the drawing.
    fn target(&self, axis: usize, word: &Word) -> Result<Option<f64>, Lost> {
        let number = word.decimal().ok_or(Lost::Expression)?;
        let (Some(unit), Some(distance)) = (self.modal.unit, self.modal.distance) else {
            return Err(Lost::ModeUnknown);
        };
        if let Some((_, distortion)) = self.modal.distortion().filter(|_| axis < 2) {
            return Err(Lost::Distorted(distortion));
        }
        let millimetres = number.value() * unit.millimetres();
        if distance == Distance::Incremental {
            return Ok(self.modal.at[axis].map(|from| from + millimetres));
        }
        let origin = match axis {
            0 => self.modal.origin.map(|origin| origin.x),
            1 => self.modal.origin.map(|origin| origin.y),
            _ => Some(0.0),
        };
        origin.map(|origin| Some(origin + millimetres)).ok_or(Lost::OffsetUnknown)
    }

    fn rapid(
        &self,
        block: &Block,
        from: [Option<f64>; 3],
        to: &[Result<Option<f64>, Lost>],
        axes: [Option<&Word>; 3],
        other: Option<u8>,
        read: &Read,
    ) -> Rapid {
        let does_more = block.words.iter().map(|word| word.letter).find(|letter| !b"NGXYZF".contains(letter));
        let role = match (other, does_more) {
            (Some(axis), _) => RapidRole::WithAxis(axis),
            // Words of a tool length (H, D) change nothing that moves along.
            (None, Some(letter)) if !b"HD".contains(&letter) => RapidRole::WithOthers(letter),
            _ if read.modes || read.feed => RapidRole::WithModes,
            _ => RapidRole::Plain,
        };
        let at = |axis: usize| to.get(axis).and_then(|target| target.as_ref().ok().copied().flatten());
        Rapid {
            from,
            to: [at(0), at(1), at(2)],
            along: axes[0].is_some() || axes[1].is_some(),
            up_or_down: axes[2].is_some(),
            role,
        }
    }

    /// Where a canned cycle ends: at its hole, in the plane that it returns to.
    fn cycle(&mut self, block: &Block, line: u32, to: &[Result<Option<f64>, Lost>]) {
        let repeats = block.word(b'L').or_else(|| block.word(b'K'));
        let count = repeats.map_or(Some(1), |word| word.decimal().and_then(crate::decimal::Decimal::whole));
        let once = count == Some(1) || (count > Some(1) && self.modal.distance == Some(Distance::Absolute));
        for (axis, target) in to.iter().enumerate().take(2) {
            match (target, once) {
                (Ok(Some(target)), true) => self.modal.at[axis] = Some(*target),
                (Err(lost), true) => self.modal.lose(axis, line, *lost),
                (Ok(None), true) => {}
                (_, false) => self.modal.lose(axis, line, Lost::UnknownMove),
            }
        }
        if let Some(word) = block.word(b'R') {
            let absolute = self.modal.distance == Some(Distance::Absolute);
            let plane = word.decimal().zip(self.modal.unit).filter(|_| absolute);
            self.modal.cycle_plane = plane.map(|(number, unit)| number.value() * unit.millimetres());
        }
        let plane = self.modal.cycle_plane;
        let z = match self.modal.retract {
            Some(Retract::Plane) => plane,
            Some(Retract::Initial) => self.modal.at[2].zip(plane).map(|(initial, plane)| initial.max(plane)),
            None => None,
        };
        match z {
            Some(z) => self.modal.at[2] = Some(z),
            None => self.modal.lose(2, line, Lost::UnknownMove),
        }
    }

    /// A turning axis turns the obstacles away from where the drawing has them.
    fn turning(&mut self, block: &Block, line: u32) {
        let mut any = false;
        for (turned, letter) in self.turned.iter_mut().zip(*b"ABC") {
            if let Some(word) = block.word(letter) {
                let home = word.decimal().is_some_and(crate::decimal::Decimal::is_zero);
                let absolute = self.modal.distance == Some(Distance::Absolute);
                *turned = if absolute { !home } else { *turned || !home };
                any = true;
            }
        }
        if any {
            let turned = self.turned.iter().any(|turned| *turned);
            self.modal.distortions[Distortion::Turned as usize] = if turned { line.max(1) } else { 0 };
        }
    }
}

/// What the words of one block have said so far.
#[derive(Default)]
struct Read {
    motion: Option<Motion>,
    distance: Option<Distance>,
    once: Option<Once>,
    /// Axis words belong to a mode, not to a move.
    consumes: bool,
    forgets: bool,
    unknown: bool,
    /// A code that is a curve when axis words stand beside it.
    curve: bool,
    feed: bool,
    modes: bool,
}

/// A position without a point, other than 0.
fn no_point(block: &Block) -> Option<Fault> {
    let is_position = |word: &&Word| matches!(word.letter, b'X' | b'Y' | b'Z' | b'I' | b'J' | b'K' | b'R');
    let unclear = |word: &&Word| word.decimal().is_some_and(|number| !number.has_point && !number.is_zero());
    let cycle_repeat = |word: &&Word| word.letter != b'K' || block.word(b'Z').is_none();
    let found = block.words.iter().filter(is_position).filter(unclear).find(cycle_repeat);
    found.map(|word| Fault::NoPoint(word.letter))
}
