//! Text in SVG: escaping, measuring, numbers.

/// The text with what XML reserves escaped and what it forbids replaced.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c if c.is_control() => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// How heavy letters are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Weight {
    Regular,
    Bold,
}

/// Widths of the characters from space to tilde in hundredths of the letter size: those of DejaVu Sans, the widest of
/// the usual sans-serif fonts.
#[rustfmt::skip]
const REGULAR: [u8; 95] = [
    32, 41, 46, 84, 64, 96, 78, 28, 40, 40, 50, 84, 32, 37, 32, 34, 64, 64, 64, 64, 64, 64, 64, 64, 64, 64,
    34, 34, 84, 84, 84, 54, 101, 69, 69, 70, 78, 64, 58, 78, 76, 30, 30, 66, 56, 87, 75, 79, 61, 79, 70, 64,
    62, 74, 69, 99, 69, 62, 69, 40, 34, 40, 84, 50, 50, 62, 64, 55, 64, 62, 36, 64, 64, 28, 28, 58, 28, 98,
    64, 62, 64, 64, 42, 53, 40, 64, 60, 82, 60, 60, 53, 64, 34, 64, 84,
];
/// The same of its bold letters.
#[rustfmt::skip]
const BOLD: [u8; 95] = [
    35, 46, 53, 84, 70, 101, 88, 31, 46, 46, 53, 84, 38, 42, 38, 37, 70, 70, 70, 70, 70, 70, 70, 70, 70,
    70, 40, 40, 84, 84, 84, 59, 101, 78, 77, 74, 84, 69, 69, 83, 84, 38, 38, 78, 64, 100, 84, 86, 74,
    86, 78, 73, 69, 82, 78, 111, 78, 73, 73, 46, 37, 46, 84, 50, 50, 68, 72, 60, 72, 68, 44, 72, 72, 35,
    35, 67, 35, 105, 72, 69, 72, 72, 50, 60, 48, 72, 66, 93, 65, 66, 59, 72, 37, 72, 84,
];

/// Width of the text at that letter size, set without kerning: an upper bound for the widest of the usual sans-serif fonts.
pub(super) fn width_of(text: &str, size: f64, weight: Weight) -> f64 {
    let (widths, other) = match weight {
        Weight::Regular => (&REGULAR, 110),
        Weight::Bold => (&BOLD, 133),
    };
    let first = u32::from(' ');
    let width = |c: char| *widths.get(u32::from(c).wrapping_sub(first) as usize).unwrap_or(&other);
    size / 100.0 * text.chars().map(|c| f64::from(width(c))).sum::<f64>()
}

/// The text, shortened with an ellipsis to fit into that width.
pub(super) fn fitted(text: &str, size: f64, weight: Weight, width: f64) -> String {
    if width_of(text, size, weight) <= width {
        return text.to_owned();
    }
    let mut short = String::new();
    let mut left = width - width_of("…", size, weight);
    for c in text.chars() {
        left -= width_of(c.encode_utf8(&mut [0; 4]), size, weight);
        if left < 0.0 {
            break;
        }
        short.push(c);
    }
    short.trim_end().to_owned() + "…"
}

/// The text broken at its spaces, into at most `most_lines`; the last one then ends in an ellipsis.
pub(super) fn wrapped(text: &str, size: f64, weight: Weight, width: f64, most_lines: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let count = lines.len();
        let Some(line) = lines.last_mut() else { break };
        let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if line.is_empty() || width_of(&longer, size, weight) <= width {
            *line = fitted(&longer, size, weight, width);
        } else if count == most_lines {
            *line = fitted(&longer, size, weight, width);
            break;
        } else {
            lines.push(fitted(word, size, weight, width));
        }
    }
    lines
}

/// Millimetres with three digits after the point, without the zeros at the end.
pub(super) fn millimetres(value: f64) -> String {
    let text = format!("{value:.3}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    format!("{} mm", if short == "-0" { "0" } else { short })
}

/// Millimetres with as many digits as a round number below 1 needs.
pub(super) fn round_millimetres(value: f64) -> String {
    let digits = (-value.log10().floor()).clamp(0.0, 12.0) as usize;
    format!("{value:.digits$} mm")
}

#[cfg(test)]
#[allow(clippy::panic, reason = "a test fails by panicking")]
mod tests {
    use super::{Weight, fitted, round_millimetres, width_of, wrapped};
    use crate::picture::Lettering;
    use crate::png::width_of as width_in_font;

    /// The widths are upper bounds for the font of PNG pictures, and near ones.
    #[test]
    fn text_is_no_wider_than_measured() {
        let all: String = (' '..='~').collect();
        let mut texts: Vec<String> = all.chars().map(|c| format!("n{}n", c.to_string().repeat(20))).collect();
        texts.extend([
            all,
            String::from("Öäß éñ Щж Ωλ … ≤ × °"),
            String::from("rapid move 12.345 mm, AVAVA"),
        ]);
        for text in texts {
            for (weight, bold) in [(Weight::Regular, false), (Weight::Bold, true)] {
                let drawn = width_in_font(&text, &Lettering { size: 100.0, bold, centred: false });
                let measured = width_of(&text, 100.0, weight);
                assert!(drawn <= measured + 0.1, "{text} {weight:?}: {drawn} {measured}");
                assert!(!text.is_ascii() || measured <= 1.1 * drawn, "{text} {weight:?}: {drawn} {measured}");
            }
        }
    }

    #[test]
    fn shortened_text_fits() {
        for text in ["a word that is long", "日本語日本語日本語日本語", "WWWWWWWWWWWWWWWWWWWWW", ""]
        {
            for weight in [Weight::Regular, Weight::Bold] {
                assert!(width_of(&fitted(text, 20.0, weight, 90.0), 20.0, weight) <= 90.0, "{text}");
                let lines = wrapped(text, 20.0, weight, 90.0, 2);
                assert!(lines.len() <= 2 && lines.iter().all(|line| width_of(line, 20.0, weight) <= 90.0));
            }
        }
        assert_eq!(wrapped("ab cd ef", 10.0, Weight::Regular, 30.0, 5), ["ab cd", "ef"]);
    }

    #[test]
    fn round_lengths_are_written_in_full() {
        for (value, text) in [(0.00002, "0.00002 mm"), (0.5, "0.5 mm"), (1.0, "1 mm"), (2000.0, "2000 mm")] {
            assert_eq!(round_millimetres(value), text);
        }
    }
}
