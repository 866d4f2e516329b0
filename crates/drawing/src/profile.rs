//! Machine profiles: what stays the same from job to job, by machine, in a TOML file.

mod convert;
mod error;
mod line_index;
mod raw;
mod speeds;
mod tools;

pub use error::{ProfileError, ProfileFinding};
pub use speeds::{JUNCTION_DEVIATION_MM, MachineSpeeds};

use crate::{GcodeSettings, ObstacleRole, Roles, SceneOptions, Selector};
use std::collections::BTreeMap;
use std::io::Read;
use traverse_geometry::{CornerStyle, RapidMotion, Vector};

/// The longest profile file, bytes.
pub const PROFILE_BYTE_LIMIT: u64 = 256 << 10;

/// One machine of a profile file. What the file does not state is absent.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Its name in the file.
    pub name: String,
    /// What bounds the work area.
    pub work_area: Option<Vec<Selector>>,
    /// What is a part.
    pub parts: Option<Vec<Selector>>,
    /// What is a section.
    pub sections: Option<Vec<Selector>>,
    /// What is an obstacle.
    pub obstacles: Option<Vec<ObstacleRole>>,
    /// Clearance from obstacles, millimetres.
    pub clearance_mm: Option<f64>,
    /// Clearance from the work area's border, millimetres.
    pub border_clearance_mm: Option<f64>,
    /// How barriers turn convex corners.
    pub corner_style: Option<CornerStyle>,
    /// How its programs are written. Absent: the file has no `gcode` table for it.
    pub gcode: Option<GcodeSettings>,
    /// Clearance from obstacles by tool number, millimetres.
    pub tool_clearances_mm: BTreeMap<u32, f64>,
    /// Where the zeros of work offsets lie in the drawing, millimetres: 0 is G54, 5 is G59, 6 to 8 are G59.1 to G59.3.
    pub offsets: BTreeMap<u8, Vector>,
    /// How G0 runs straight moves.
    pub g0: Option<RapidMotion>,
    /// How fast it moves.
    pub speeds: MachineSpeeds,
}

impl Machine {
    /// Puts what the profile states in the place of what `options` hold; leaves the rest.
    pub fn apply_to(&self, options: &mut SceneOptions) {
        let Roles { work_area, parts, sections, obstacles } = &mut options.roles;
        for (stated, role) in [(&self.work_area, work_area), (&self.parts, parts), (&self.sections, sections)]
        {
            if let Some(selectors) = stated {
                role.clone_from(selectors);
            }
        }
        if let Some(stated) = &self.obstacles {
            obstacles.clone_from(stated);
        }
        if let Some(clearance_mm) = self.clearance_mm {
            options.clearance_mm = clearance_mm;
        }
        if self.border_clearance_mm.is_some() {
            options.work_area_clearance_mm = self.border_clearance_mm;
        }
        if let Some(corner_style) = self.corner_style {
            options.corner_style = corner_style;
        }
    }
}

/// The machines of a profile file.
///
/// ```toml
/// [machine.plasma-2]
/// clearance_mm = 3.0
/// border_clearance_mm = 0.0        # absent: clearance_mm
/// corner_style = "round"           # or "miter", then miter_limit = 4.0 if wanted
/// g0 = "linear"                    # or "dog-leg": each axis at its own speed
///
/// [machine.plasma-2.roles]         # layers by pattern, * stands for any text; or id:, group:, color:
/// work_area = ["TABLE*"]
/// parts = ["group:part-*"]         # absent: none
/// sections = ["group:section-*"]   # absent: none
/// obstacles = ["PARTS_*", { select = "color:red", top_mm = 25.0, clearance_mm = 4.0 }]
///
/// [machine.plasma-2.speeds]
/// arc_feed_mm_per_min = 6000       # needed unless arcs = "chords"
/// straight_feed_mm_per_min = 9000  # needed for straight = "G1"
/// rapid_mm_per_min = 20000         # absent: no times are told
/// rapid_x_mm_per_min = 24000       # where each axis has its own speed: for times of axes, and for g0 = "dog-leg"
/// rapid_y_mm_per_min = 18000
/// rapid_z_mm_per_min = 6000
/// acceleration_mm_per_s2 = 1500    # with rapid_mm_per_min: for times with speeding up and slowing down
/// junction_deviation_mm = 0.01     # permitted deviation at corners; absent: 0.01
///
/// [machine.plasma-2.tools]         # clearances by tool number; absent: clearance_mm
/// 1 = { clearance_mm = 4.0 }
/// 2 = { diameter_mm = 12.0, margin_mm = 1.0 }
///
/// [machine.plasma-2.offsets]       # where zeros of work offsets lie in the drawing; absent: G54 at its zero
/// G54 = [0, 0]
/// G55 = [300, 0]
///
/// [machine.plasma-2.gcode]
/// dialect = "linuxcnc"             # or "grbl", "fanuc"
/// unit = "mm"                      # or "inch"
/// plane = "G17"                    # or "G18": x is the machine's Z, y its X
/// # x_word = "diameter"            # or "radius"; G18 only
/// decimals = 3                     # absent: as few as the controller accepts
/// straight = "G0"                  # or "G1"
/// arcs = "fed"                     # or "chords"
/// # chord_tolerance_mm = 0.01      # chords only
/// safe_start = ["G90 G91.1 G40"]   # absent: the dialect's own
/// header = ["(PLASMA 2)"]
/// footer = ["M30"]
/// # program_number = 1             # fanuc only
/// ```
///
/// Every key may be left out. Keys that are not in this list are refused, and so are keys that have no effect.
#[derive(Clone, Debug, PartialEq)]
pub struct Profiles {
    file: String,
    machines: Vec<Machine>,
}

impl Profiles {
    /// Reads a profile file; `file` is its name, for messages.
    ///
    /// # Errors
    /// When the reader fails, the file is longer than [`PROFILE_BYTE_LIMIT`], or anything in it is wrong. TOML
    /// mistakes and unknown keys are reported one at a time, values out of range all at once.
    pub fn read_from(reader: impl Read, file: &str) -> Result<Self, ProfileError> {
        let mut bytes = Vec::new();
        reader
            .take(PROFILE_BYTE_LIMIT + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| ProfileError::Io { file: file.to_owned(), message: error.to_string() })?;
        if bytes.len() as u64 > PROFILE_BYTE_LIMIT {
            return Err(ProfileError::TooLong { file: file.to_owned(), limit: PROFILE_BYTE_LIMIT });
        }
        let text = str::from_utf8(&bytes).map_err(|error| ProfileError::NotUtf8 {
            file: file.to_owned(),
            line: 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count(),
        })?;
        Self::from_toml(text, file)
    }

    fn from_toml(text: &str, file: &str) -> Result<Self, ProfileError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let read = raw::read(text).and_then(|raw| convert::machines(raw, text));
        let machines = read.map_err(|findings| ProfileError::Findings { file: file.to_owned(), findings })?;
        Ok(Self { file: file.to_owned(), machines })
    }

    /// The machines, by name.
    #[must_use]
    pub fn machines(&self) -> &[Machine] {
        &self.machines
    }

    /// The machine of that name, upper and lower case told apart.
    ///
    /// # Errors
    /// When the file has none of that name: says which it has.
    pub fn machine(&self, name: &str) -> Result<&Machine, ProfileError> {
        self.machines.iter().find(|machine| machine.name == name).ok_or_else(|| {
            let known: Vec<&str> = self.machines.iter().map(|machine| machine.name.as_str()).collect();
            ProfileError::UnknownMachine {
                file: self.file.clone(),
                name: name.to_owned(),
                known: known.join(", "),
            }
        })
    }
}
