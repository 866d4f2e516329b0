//! A program, read: its links, what could not be followed, what was not understood.

use crate::block::{Block, Fault};
use crate::codes::Distance;
use crate::error::ProgramError;
use crate::interpreter::{Deed, Interpreter, Rapid, RapidRole};
use crate::lift::Vertical;
use crate::line::{Line, lines};
use crate::link::{Heights, Link, RapidBlock, WordPlace};
use crate::modal::{Lost, Modal};
use crate::options::ReadOptions;
use crate::protection::Protection;
use crate::reason::Reason;
use crate::survey::Survey;
use traverse_drawing::{GcodeDialect, GcodeUnit};
use traverse_geometry::Point;

/// The longest program, bytes.
pub const PROGRAM_BYTE_LIMIT: usize = 256 << 20;

/// A program and what is known of it. The text itself is kept as it is, in whatever encoding.
#[derive(Clone, Debug, PartialEq)]
pub struct Program<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) survey: Survey,
    pub(crate) dialect: GcodeDialect,
    /// Every way that is known from end to end, in the program's order.
    pub links: Vec<Link>,
    /// Rapid moves that are not, by line.
    pub untouched: Vec<(u32, Reason)>,
    /// Lines that were not understood. They stay as they are, and nothing is taken for known behind them.
    pub faults: Vec<(u32, Fault)>,
    /// How many lines it has.
    pub line_count: u32,
    /// The highest place that a rapid move goes to, as far as heights are known, in the program's coordinates, millimetres.
    pub highest_rapid_z_mm: Option<f64>,
}

impl<'a> Program<'a> {
    /// Reads a program. Cost: linear in its bytes.
    ///
    /// # Errors
    /// When it is too long, no text, or no G-code. Single lines that can't be understood are no error: see
    /// [`Program::faults`].
    pub fn read(bytes: &'a [u8], options: &ReadOptions) -> Result<Self, ProgramError> {
        if bytes.len() > PROGRAM_BYTE_LIMIT {
            return Err(ProgramError::TooLong { limit: PROGRAM_BYTE_LIMIT });
        }
        if let Some(at) = bytes.iter().position(|byte| *byte == 0) {
            let line = 1 + bytes[..at].iter().filter(|byte| **byte == b'\n').count();
            return Err(ProgramError::NoText { line });
        }
        let survey = Survey::of(bytes);
        let dialect = options.dialect(&survey);
        let mut reader = Reader {
            program: Self {
                bytes,
                survey: survey.clone(),
                dialect,
                links: Vec::new(),
                untouched: Vec::new(),
                faults: Vec::new(),
                line_count: 0,
                highest_rapid_z_mm: None,
            },
            open: None,
            retract: None,
            protected: false,
        };
        let mut interpreter = Interpreter::new(options, &survey);
        let mut block = Block::default();
        for line in lines(bytes) {
            block.read(&bytes[line.start..line.end]);
            reader.line(line, &block, &mut interpreter);
        }
        reader.close();
        let program = reader.program;
        if program.survey.understood == 0 && program.survey.controls > 0 {
            return Err(ProgramError::NoBlocks);
        }
        if program.survey.faults > program.survey.understood {
            let first = program.faults.first().map(|(line, fault)| (*line, *fault));
            let (line, fault) = first.unwrap_or((1, Fault::NoCode));
            return Err(ProgramError::NoProgram { line, fault, faults: program.survey.faults });
        }
        Ok(program)
    }
}

/// Collects links while blocks are run.
struct Reader<'a> {
    program: Program<'a>,
    open: Option<Link>,
    /// The line before, if all it did was rise.
    retract: Option<(u32, Option<Vertical>)>,
    protected: bool,
}

impl Reader<'_> {
    fn line(&mut self, line: Line, block: &Block, interpreter: &mut Interpreter<'_>) {
        self.program.line_count = line.number;
        match block.protection {
            Some(Protection::Off) => self.protected = true,
            Some(Protection::On) => self.protected = false,
            Some(Protection::Keep) | None => {}
        }
        let protected = self.protected || block.protection == Some(Protection::Keep);
        let before = interpreter.modal.clone();
        match interpreter.run(block, line.number, line.start) {
            Deed::Idle => {}
            Deed::Other | Deed::Behind => {
                self.close();
                self.retract = None;
            }
            Deed::Vague(reason) => {
                self.close();
                self.retract = None;
                self.program.untouched.push((line.number, reason));
            }
            Deed::Fault(fault) => {
                self.close();
                self.retract = None;
                self.program.faults.push((line.number, fault));
            }
            Deed::Rapid(rapid) => {
                let after = &interpreter.modal;
                self.rapid(line, block, &rapid, before, after, protected);
            }
        }
    }

    fn close(&mut self) {
        self.program.links.extend(self.open.take());
    }

    fn rapid(
        &mut self,
        line: Line,
        block: &Block,
        rapid: &Rapid,
        before: Modal,
        after: &Modal,
        protected: bool,
    ) {
        if let Some(z) = rapid.to[2].filter(|_| rapid.role != RapidRole::Skippable && rapid.up_or_down) {
            let highest = &mut self.program.highest_rapid_z_mm;
            *highest = Some(highest.map_or(z, |highest| highest.max(z)));
        }
        if !rapid.along {
            self.straight_up_or_down(line, block, rapid, after, protected);
            return;
        }
        let (Some(from), Some(to)) = (point(rapid.from), point(rapid.to)) else {
            self.close();
            self.retract = None;
            let reason = unknown(rapid, &before, after);
            self.program.untouched.push((line.number, reason));
            return;
        };
        let slope = match (rapid.up_or_down, rapid.from[2], rapid.to[2]) {
            (false, z, _) => Ok(Heights::Level(z)),
            (true, Some(from), Some(to)) if from == to => Ok(Heights::Level(Some(to))),
            (true, Some(from), Some(to)) => Ok(Heights::Sloped { from, to }),
            (true, _, z) => Err(z),
        };
        let distance = after.distance.unwrap_or(Distance::Absolute);
        let fixed = match (rapid.role, &slope) {
            (RapidRole::Skippable, _) => Some(Reason::Skippable),
            _ if protected => Some(Reason::Protected),
            (RapidRole::Cycle, _) => Some(Reason::Cycle),
            (RapidRole::WithAxis(letter), _) => Some(Reason::OtherAxis(letter)),
            (RapidRole::WithOthers(letter), _) => Some(Reason::DoesMore(letter)),
            (_, Err(_)) => Some(Reason::HeightUnknown),
            (_, Ok(Heights::Sloped { .. })) if distance == Distance::Incremental => {
                Some(Reason::SlopedIncrements)
            }
            _ => None,
        };
        let heights = slope.unwrap_or(Heights::Level(None));
        let Some(step) = rapid_block(line, block, to, distance, after.unit) else {
            self.close();
            self.retract = None;
            self.program.untouched.push((line.number, Reason::NumberTooLarge));
            return;
        };
        let level = matches!(heights, Heights::Level(_)) && !rapid.up_or_down;
        if let Some(open) = &mut self.open
            && matches!(rapid.role, RapidRole::Plain | RapidRole::WithModes)
            && fixed.is_none()
            && level
            && open.fixed.is_none()
            && matches!(open.heights, Heights::Level(_))
            && open.blocks.last().is_some_and(|last| last.words[2].is_none())
        {
            open.blocks.push(step);
            *open.before = before;
            return;
        }
        self.close();
        let (tool, tool_is_known) = Link::tool_of(after.tool);
        let (retract_line, retract) = self.retract.take().unzip();
        self.open = Some(Link {
            from,
            heights,
            retract_line,
            plunge_line: None,
            retract: retract.flatten(),
            plunge: None,
            tool,
            tool_is_known,
            fixed,
            blocks: vec![step],
            before: Box::new(before),
        });
    }

    /// A move along Z alone parts links; next to one it is its retract or its plunge.
    fn straight_up_or_down(
        &mut self,
        line: Line,
        block: &Block,
        rapid: &Rapid,
        after: &Modal,
        protected: bool,
    ) {
        let rises = rapid.to[2].zip(rapid.from[2]).is_none_or(|(to, from)| to > from);
        let known = vertical(line, block, rapid, after, protected);
        if let Some(open) = &mut self.open
            && !rises
        {
            open.plunge_line = Some(line.number);
            open.plunge.clone_from(&known);
        }
        self.close();
        self.retract = (rapid.up_or_down && rises).then_some((line.number, known));
    }
}

/// The move along Z as far as it is known; none: it may not run, or does more.
fn vertical(line: Line, block: &Block, rapid: &Rapid, after: &Modal, protected: bool) -> Option<Vertical> {
    let moves_z = rapid.up_or_down && after.distance == Some(Distance::Absolute);
    // What else a block does would run at another height.
    let runs = matches!(rapid.role, RapidRole::Plain | RapidRole::WithModes);
    let at = point(rapid.from).filter(|_| moves_z && runs)?;
    Some(Vertical {
        from_z: rapid.from[2]?,
        to_z: rapid.to[2]?,
        block: rapid_block(line, block, at, Distance::Absolute, after.unit)?,
        is_free: !protected,
    })
}

fn point(at: [Option<f64>; 3]) -> Option<Point> {
    Some(Point::new(at[0]?, at[1]?))
}

fn rapid_block(
    line: Line,
    block: &Block,
    target: Point,
    distance: Distance,
    unit: Option<GcodeUnit>,
) -> Option<RapidBlock> {
    let place = |offset: usize| u32::try_from(line.start + offset).ok();
    let word = |letter: u8| {
        let word = block.word(letter)?;
        let value = word.decimal()?;
        let (letter, number, end) = (place(word.span.start)?, place(word.number)?, place(word.span.end)?);
        Some(WordPlace { letter, number, end, value })
    };
    Some(RapidBlock {
        line: line.number,
        start: u32::try_from(line.start).ok()?,
        end: u32::try_from(line.end).ok()?,
        next: u32::try_from(line.next).ok()?,
        words: [word(b'X'), word(b'Y'), word(b'Z')],
        target,
        distance,
        unit,
        names_motion: block
            .words
            .iter()
            .any(|word| word.letter == b'G' && word.decimal().is_some_and(crate::decimal::Decimal::is_zero)),
        sets_feed: block.word(b'F').is_some(),
    })
}

/// Which of the two ends is not known, and why.
fn unknown(rapid: &Rapid, before: &Modal, after: &Modal) -> Reason {
    if let Some((line, distortion)) = after.distortion() {
        return Reason::Distorted { line, distortion };
    }
    if point(rapid.from).is_none() {
        // Known before the block: something in the block itself is to blame.
        let (line, lost) = if point(before.at).is_some() { after.lost[0] } else { before.lost[0] };
        return Reason::StartUnknown { line, lost };
    }
    let (_, lost) = after.lost[0];
    Reason::TargetUnknown { lost: if point(after.at).is_none() { lost } else { Lost::ModeUnknown } }
}
