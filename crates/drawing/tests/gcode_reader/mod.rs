//! A small reader of G-code, as a controller reads it. It shares nothing with what writes.

#![allow(dead_code, reason = "each test uses its part")]

use std::f64::consts::TAU;

/// What the controller knows between blocks.
#[derive(Clone, Debug)]
pub(crate) struct Controller {
    /// Last motion G code.
    pub(crate) motion: Option<u32>,
    pub(crate) feed: Option<f64>,
    /// 17 or 18.
    pub(crate) plane: u32,
    /// Millimetres in one unit.
    pub(crate) unit_mm: f64,
    pub(crate) x_is_diameter: bool,
    pub(crate) rules: Rules,
    /// In drawing coordinates, millimetres.
    pub(crate) at: [f64; 2],
    pub(crate) ended: bool,
}

/// What a make of controller refuses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rules {
    pub(crate) needs_point: bool,
    pub(crate) longest_line: usize,
    /// Radii may differ by `radius_mm`, and by more if that is within this share of the radius.
    pub(crate) radius_mm: f64,
    pub(crate) radius_share: f64,
    pub(crate) single_precision: bool,
    pub(crate) most_digits: usize,
}

/// One move in the drawing, millimetres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Move {
    pub(crate) from: [f64; 2],
    pub(crate) to: [f64; 2],
    /// Centre and turned angle.
    pub(crate) arc: Option<([f64; 2], f64)>,
    /// None: rapid.
    pub(crate) feed_mm: Option<f64>,
}

impl Move {
    pub(crate) fn length(&self) -> f64 {
        match self.arc {
            None => distance(self.from, self.to),
            Some((center, turn)) => distance(self.from, center) * turn.abs(),
        }
    }

    pub(crate) fn at(&self, share: f64) -> [f64; 2] {
        match self.arc {
            None => [0, 1].map(|i| self.from[i] + (self.to[i] - self.from[i]) * share),
            Some((center, turn)) => {
                // A spiral from one radius to the other, as controllers do it.
                let (r0, r1) = (distance(self.from, center), distance(self.to, center));
                let r = r0 + (r1 - r0) * share;
                let angle = (self.from[1] - center[1]).atan2(self.from[0] - center[0]) + turn * share;
                [center[0] + r * angle.cos(), center[1] + r * angle.sin()]
            }
        }
    }
}

pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

impl Controller {
    /// Reads blocks; gives the moves, or why a block is refused.
    pub(crate) fn read<'a>(&mut self, lines: impl IntoIterator<Item = &'a str>) -> Result<Vec<Move>, String> {
        let mut moves = Vec::new();
        for line in lines {
            let refused = |why: String| format!("{why}: {line}");
            if line.len() > self.rules.longest_line {
                return Err(refused("too long".to_owned()));
            }
            if line == "%" || line.starts_with('O') {
                continue;
            }
            if self.ended {
                return Err(refused("after the end".to_owned()));
            }
            moves.extend(self.block(line).map_err(refused)?);
        }
        Ok(moves)
    }

    fn block(&mut self, line: &str) -> Result<Option<Move>, String> {
        let (mut x, mut y, mut z) = (None, None, None);
        let (mut i, mut j, mut k) = (None, None, None);
        for (letter, text) in words(line)? {
            let value: f64 = text.parse().map_err(|_| format!("`{text}` is no number"))?;
            match letter {
                'G' => self.modal(text)?,
                'M' => self.ended |= text == "30" || text == "2",
                'F' => self.feed = Some(value),
                _ => {
                    if self.rules.needs_point && !text.contains('.') {
                        return Err(format!("{letter}{text} has no point"));
                    }
                    if text.chars().filter(char::is_ascii_digit).count() > self.rules.most_digits {
                        return Err(format!("{letter}{text} has too many digits"));
                    }
                    let slot = match letter {
                        'X' => &mut x,
                        'Y' => &mut y,
                        'Z' => &mut z,
                        'I' => &mut i,
                        'J' => &mut j,
                        'K' => &mut k,
                        _ => return Err(format!("unknown word {letter}")),
                    };
                    if slot.replace(value).is_some() {
                        return Err(format!("{letter} twice"));
                    }
                }
            }
        }
        let (a, b, ca, cb) = match self.plane {
            17 if z.is_none() && k.is_none() => (x, y, i, j),
            18 if y.is_none() && j.is_none() => {
                (z, x.map(|x| if self.x_is_diameter { x / 2.0 } else { x }), k, i)
            }
            _ => return Err("axis out of plane".to_owned()),
        };
        if a.is_none() && b.is_none() {
            return Ok(None);
        }
        let mm = |word: Option<f64>, now: f64| word.map_or(now, |word| self.single(word * self.unit_mm));
        let (from, to) = (self.at, [mm(a, self.at[0]), mm(b, self.at[1])]);
        let feed = self.feed.map(|feed| feed * self.unit_mm);
        let made = match self.motion.ok_or("no motion mode")? {
            0 => Move { from, to, arc: None, feed_mm: None },
            1 => Move { from, to, arc: None, feed_mm: Some(feed.ok_or("no feed")?) },
            motion => {
                if ca.is_none() && cb.is_none() {
                    return Err("no centre".to_owned());
                }
                let center = [from[0] + mm(ca, 0.0), from[1] + mm(cb, 0.0)];
                let (r0, r1) = (distance(from, center), distance(to, center));
                let apart = (r0 - r1).abs();
                if apart > self.rules.radius_mm && apart > self.rules.radius_share * r0 {
                    return Err(format!("radii {apart} apart"));
                }
                let angle = |p: [f64; 2]| (p[1] - center[1]).atan2(p[0] - center[0]);
                let mut turn = angle(to) - angle(from);
                // Grbl's ARC_ANGULAR_TRAVEL_EPSILON: as good as no turn is a full one.
                if motion == 3 {
                    turn = if turn <= 5e-7 { turn + TAU } else { turn };
                } else {
                    turn = if turn >= -5e-7 { turn - TAU } else { turn };
                }
                Move { from, to, arc: Some((center, turn)), feed_mm: Some(feed.ok_or("no feed")?) }
            }
        };
        self.at = to;
        Ok(Some(made))
    }

    fn modal(&mut self, text: &str) -> Result<(), String> {
        match text {
            "0" | "1" | "2" | "3" => self.motion = text.parse().ok(),
            "17" | "18" => self.plane = text.parse().map_err(|_| "plane")?,
            "20" => self.unit_mm = 25.4,
            "21" => self.unit_mm = 1.0,
            "7" => self.x_is_diameter = true,
            "8" => self.x_is_diameter = false,
            "90" | "91.1" | "94" | "40" | "80" | "61" | "98" => {}
            _ => return Err(format!("unknown G{text}")),
        }
        Ok(())
    }

    fn single(&self, value: f64) -> f64 {
        if self.rules.single_precision { f64::from(value as f32) } else { value }
    }
}

/// Letters and numbers of a block, without comments.
fn words(line: &str) -> Result<Vec<(char, &str)>, String> {
    let mut words = Vec::new();
    let mut rest = line;
    while let Some(letter) = rest.chars().next() {
        if letter == ' ' {
            rest = &rest[1..];
        } else if letter == '(' {
            rest = rest.split_once(')').ok_or("open comment")?.1;
        } else if letter.is_ascii_uppercase() {
            rest = &rest[1..];
            let end = rest.find(|c: char| !matches!(c, '0'..='9' | '.' | '-')).unwrap_or(rest.len());
            words.push((letter, &rest[..end]));
            rest = &rest[end..];
        } else {
            return Err(format!("`{letter}` begins no word"));
        }
    }
    Ok(words)
}
