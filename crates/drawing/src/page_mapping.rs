//! How coordinates of a page become millimetres.

use std::fmt;

/// How coordinates of an SVG file, outside all its transforms, became millimetres: y up, the origin at the lower left
/// of the page. Written as one line.
///
/// x_mm = `mm_per_unit_x` (x − `left`), y_mm = `page_height_mm` − `mm_per_unit_y` (y − `top`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageMapping {
    /// Millimetres in one user unit along x.
    pub mm_per_unit_x: f64,
    /// Millimetres in one user unit along y. Other than along x only when the file asks for that.
    pub mm_per_unit_y: f64,
    /// The page's left edge, user units.
    pub left: f64,
    /// The page's upper edge, user units.
    pub top: f64,
    /// Width of the page, millimetres; 0 when the file gives no page.
    pub page_width_mm: f64,
    /// Height of the page, millimetres; 0 when the file gives no page: y_mm is then negative below its origin.
    pub page_height_mm: f64,
}

impl fmt::Display for PageMapping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let short =
            |number: f64| format!("{number:.4}").trim_end_matches('0').trim_end_matches('.').to_owned();
        let (x, y) = (short(self.mm_per_unit_x), short(self.mm_per_unit_y));
        let from = |edge: f64, axis: &str| {
            let sign = if edge < 0.0 { '+' } else { '-' };
            format!("({axis} {sign} {})", short(edge.abs()))
        };
        write!(f, "1 user unit = {x} mm")?;
        if x != y {
            write!(f, " in x and {y} mm in y")?;
        }
        let (width, height) = (short(self.page_width_mm), short(self.page_height_mm));
        write!(f, "; page {width} x {height} mm; x_mm = {x} {}", from(self.left, "x"))?;
        write!(f, ", y_mm = {height} - {y} {}", from(self.top, "y"))
    }
}
