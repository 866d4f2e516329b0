//! Text in SVG: escaping, measuring, numbers.

use std::fmt::Write;

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

/// Width of the text at that letter size, estimated generously for the widest of the usual sans-serif fonts.
pub(super) fn width_of(text: &str, size: f64) -> f64 {
    let share = |c: char| match c {
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ' ' | '/' | '\'' => 0.36,
        'm' | 'w' | 'M' | 'W' | '@' => 0.98,
        c if c.is_ascii_uppercase() => 0.72,
        c if c.is_ascii() => 0.64,
        _ => 1.0,
    };
    size * text.chars().map(share).sum::<f64>()
}

/// The text, shortened with an ellipsis to fit into that width.
pub(super) fn fitted(text: &str, size: f64, width: f64) -> String {
    if width_of(text, size) <= width {
        return text.to_owned();
    }
    let mut short = String::new();
    let mut left = width - size;
    for c in text.chars() {
        left -= width_of(c.encode_utf8(&mut [0; 4]), size);
        if left < 0.0 {
            break;
        }
        short.push(c);
    }
    short.trim_end().to_owned() + "…"
}

/// A text element. `class` names its style.
pub(super) fn push_text(svg: &mut String, class: &str, x: f64, y: f64, text: &str) {
    let _ = writeln!(svg, "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>", escaped(text));
}

/// Millimetres with three digits after the point, without the zeros at the end.
pub(super) fn millimetres(value: f64) -> String {
    let text = format!("{value:.3}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    format!("{} mm", if short == "-0" { "0" } else { short })
}
