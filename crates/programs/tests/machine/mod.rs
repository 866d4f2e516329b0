//! A second interpreter of G-code, small and written apart from the crate's: what a machine would do.

#![allow(dead_code, reason = "each test uses its part")]

/// One move of the machine.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Move {
    /// 0 to 3.
    pub(crate) code: u8,
    pub(crate) from: [f64; 3],
    pub(crate) to: [f64; 3],
    /// X and Y of the centre, millimetres; arcs only.
    pub(crate) center: Option<[f64; 2]>,
    pub(crate) feed: f64,
    /// Counted from 0.
    pub(crate) line: usize,
}

/// What is in force behind a line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct State {
    pub(crate) motion: u8,
    pub(crate) feed: f64,
    pub(crate) absolute: bool,
    pub(crate) inches: bool,
    pub(crate) plane: u32,
    pub(crate) absolute_centers: bool,
    pub(crate) at: [f64; 3],
}

/// Runs a program of the simple kind that tests make: moves, and the state behind every line.
pub(crate) fn run(text: &str) -> (Vec<Move>, Vec<State>) {
    let mut state = State {
        motion: 0,
        feed: 0.0,
        absolute: true,
        inches: false,
        plane: 17,
        absolute_centers: false,
        at: [0.0; 3],
    };
    let (mut moves, mut states) = (Vec::new(), Vec::new());
    for (line, text) in text.lines().enumerate() {
        let words = words(text);
        let value = |letter: char| words.iter().find(|(l, _)| *l == letter).map(|(_, v)| *v);
        for &(_, code) in words.iter().filter(|(letter, _)| *letter == 'G') {
            match (code * 10.0).round() as u32 {
                motion @ (0 | 10 | 20 | 30) => state.motion = (motion / 10) as u8,
                plane @ (170 | 180 | 190) => state.plane = plane / 10,
                200 => state.inches = true,
                210 => state.inches = false,
                900 => state.absolute = true,
                910 => state.absolute = false,
                901 => state.absolute_centers = true,
                911 => state.absolute_centers = false,
                _ => {}
            }
        }
        state.feed = value('F').unwrap_or(state.feed);
        let unit = if state.inches { 25.4 } else { 1.0 };
        let axes = ['X', 'Y', 'Z'].map(|letter| value(letter).map(|v| v * unit));
        if axes.iter().any(Option::is_some) || (state.motion > 1 && value('I').or(value('J')).is_some()) {
            let mut to = state.at;
            for axis in 0..3 {
                if let Some(word) = axes[axis] {
                    to[axis] = if state.absolute { word } else { state.at[axis] + word };
                }
            }
            let center = (state.motion > 1).then(|| {
                let [i, j] = ['I', 'J'].map(|letter| value(letter).unwrap_or(0.0) * unit);
                if state.absolute_centers { [i, j] } else { [state.at[0] + i, state.at[1] + j] }
            });
            moves.push(Move {
                code: state.motion,
                from: state.at,
                to,
                center,
                feed: state.feed * unit,
                line,
            });
            state.at = to;
        }
        states.push(state.clone());
    }
    (moves, states)
}

fn words(line: &str) -> Vec<(char, f64)> {
    let mut code = String::new();
    let mut depth = 0;
    for c in line.chars() {
        match c {
            ';' if depth == 0 => break,
            '(' => depth += 1,
            ')' => depth -= 1,
            c if depth == 0 && !c.is_whitespace() => code.push(c.to_ascii_uppercase()),
            _ => {}
        }
    }
    let mut words = Vec::new();
    let mut rest = code.as_str();
    while let Some(letter) = rest.chars().next().filter(char::is_ascii_alphabetic) {
        rest = &rest[1..];
        let end = rest.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(rest.len());
        words.push((letter, rest[..end].parse().unwrap_or(f64::NAN)));
        rest = &rest[end..];
    }
    words
}
