//! Colours, line weights and fills. Every kind differs in fill or dash as well as in colour, for print.

use super::text::escaped;
use std::fmt::Write;

/// Letter size of ids and of the legend.
pub(super) const SMALL: f64 = 21.0;
/// Letter size of the list of findings.
pub(super) const SAID: f64 = 19.0;
/// Letter size of the markers' numbers.
pub(super) const NUMBER: f64 = 17.0;
/// Letter size of the header.
pub(super) const LARGE: f64 = 27.0;
/// Weight of the barrier's outline.
pub(super) const BARRIER_LINE: f64 = 1.3;

pub(super) const SHEET: &str = "
text{font-family:Helvetica,Arial,'Liberation Sans','DejaVu Sans',sans-serif;font-size:21px;font-kerning:none;fill:#1c2733}
.title{font-size:27px;font-weight:bold}
.alert{font-weight:bold;fill:#a3120a}
.strong{font-weight:bold}
.note{fill:#5c6670}
.id,.end{text-anchor:middle;stroke:#fff;stroke-width:4.5px;stroke-linejoin:round;paint-order:stroke}
.end{font-weight:bold}
.mid{text-anchor:middle}
.outside{fill:#e9ebee}
.inside{fill:#fff}
.border{fill:none;stroke:#1f6f43;stroke-width:3;stroke-dasharray:22 5 4 5}
.border.parts{stroke:#a3120a;stroke-width:5}
.rim{fill:none;stroke:#b9770e}
.barrier{fill:none;stroke:#fdebc8}
.rim .cut{fill:#b9770e}
.barrier .cut{fill:#fdebc8}
.zone{fill:#fdebc8;stroke:#b9770e;stroke-width:1.3}
.obstacle{fill:url(#hatch);fill-rule:evenodd;stroke:#39434e;stroke-width:1.8;stroke-linejoin:round}
.fine .obstacle{stroke-width:.7}
.obstacle.parts{fill:url(#cross);stroke:#a3120a;stroke-width:3}
.obstacle.passed{fill-opacity:.35;stroke-dasharray:6 4}
.casing{fill:none;stroke:#fff;stroke-width:9;stroke-linecap:round;stroke-linejoin:round}
.casing.thin{stroke-width:6}
.before{fill:none;stroke:#5c6670;stroke-width:2.2;stroke-dasharray:5 5;stroke-linejoin:round}
.rapid{fill:none;stroke:#0b4fc4;stroke-width:4;stroke-dasharray:15 8;stroke-linejoin:round}
.arrow{fill:#0b4fc4;stroke:#fff;stroke-width:1.2}
.wish{fill:none;stroke:#5c6670;stroke-width:2.5;stroke-dasharray:3 8;stroke-linecap:round}
.mark{fill:#fff;stroke:#0b1f33;stroke-width:3}
.dot{fill:#0b1f33}
.leader{stroke:#39434e;stroke-width:1.2}
.curve{fill:none;stroke-linejoin:round}
.curve.sample{stroke:#1c2733;stroke-width:2.4}
.loops{fill-rule:evenodd;fill-opacity:.1;stroke:none}
.glow{fill:none;stroke:#ffc4b8;stroke-width:13;stroke-linejoin:round}
.loose{fill:#fff;stroke:#a3120a;stroke-width:2.4}
.gapline{stroke:#a3120a;stroke-width:2.6;stroke-dasharray:6 5;fill:none}
.spot{fill:none;stroke:#a3120a;stroke-width:2.6}
.pointer{stroke:#a3120a;stroke-width:1.8;fill:none}
.lost{fill:#a3120a;stroke:#fff;stroke-width:2}
.kept{fill:#fff;stroke:#a3120a;stroke-width:2.6}
.number{font-size:17px;font-weight:bold;text-anchor:middle}
.number.on{fill:#fff}
.said{font-size:19px}
.tick{fill:#1c2733;stroke:#1c2733;stroke-width:1.2}
.gap{fill:#fff;stroke:#1c2733;stroke-width:1.2}
";

const PATTERNS: &str = "<defs>
<pattern id=\"hatch\" width=\"9\" height=\"9\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">\
<rect width=\"9\" height=\"9\" fill=\"#c9d0d8\"/><rect width=\"1.6\" height=\"9\" fill=\"#8a95a1\"/></pattern>
<pattern id=\"cross\" width=\"11\" height=\"11\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">\
<rect width=\"11\" height=\"11\" fill=\"#f7c9c2\"/><rect width=\"3\" height=\"11\" fill=\"#c8402f\"/>\
<rect width=\"11\" height=\"3\" fill=\"#c8402f\"/></pattern>
</defs>
";

/// The file up to the first shape.
pub(super) fn opening(width: f64, height: f64, summary: &str) -> String {
    let mut svg = String::new();
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         width=\"{width:.0}\" height=\"{height:.0}\" role=\"img\">"
    );
    let _ = writeln!(svg, "<title>{}</title>", escaped(summary));
    let _ = write!(svg, "<style>{SHEET}</style>\n{PATTERNS}");
    let _ = writeln!(svg, "<rect width=\"{width:.0}\" height=\"{height:.0}\" fill=\"#fff\"/>");
    svg
}
