//! DXF as pairs of group code and value.

use std::fmt::{Display, Write};
use traverse_geometry::Point;

/// The text of a DXF file in the making.
#[derive(Default)]
pub(crate) struct Groups {
    text: String,
    last_handle: u32,
}

impl Groups {
    pub(crate) fn add(&mut self, code: u16, value: impl Display) {
        // Writing to a String never fails.
        let _ = writeln!(self.text, "{code:>3}\n{value}");
    }

    pub(crate) fn number(&mut self, code: u16, value: f64) {
        // The shortest text that reads back the same, never with an exponent; −0 is 0.
        self.add(code, format_args!("{:?}", Plain(value + 0.0)));
    }

    pub(crate) fn point(&mut self, code: u16, p: Point) {
        self.number(code, p.x);
        self.number(code + 10, p.y);
        self.number(code + 20, 0.0);
    }

    /// A handle that is not in use yet.
    pub(crate) fn new_handle(&mut self) -> u32 {
        self.last_handle += 1;
        self.last_handle
    }

    /// Begins an object: type, its handle and that of its owner.
    pub(crate) fn object(&mut self, kind: &str, handle: u32, owner: u32) {
        self.add(0, kind);
        self.add(if kind == "DIMSTYLE" { 105 } else { 5 }, format_args!("{handle:X}"));
        self.add(330, format_args!("{owner:X}"));
    }

    /// Begins an entity of model space.
    pub(crate) fn entity(&mut self, kind: &str, owner: u32, layer: &str, class: &str) {
        let handle = self.new_handle();
        self.object(kind, handle, owner);
        self.add(100, "AcDbEntity");
        self.add(8, layer);
        self.add(100, class);
    }

    /// The text, with every place of `mark` taken by `value`.
    pub(crate) fn into_text(self, mark: &str, value: &str) -> String {
        self.text.replacen(mark, value, 1)
    }

    pub(crate) fn last_handle(&self) -> u32 {
        self.last_handle
    }
}

/// A number without exponent and with a point.
struct Plain(f64);

impl std::fmt::Debug for Plain {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0 == self.0.trunc() { write!(f, "{:.1}", self.0) } else { write!(f, "{}", self.0) }
    }
}
