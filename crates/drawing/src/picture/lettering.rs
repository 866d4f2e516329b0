//! How the classes of a line of text set it: the same as the style sheet says, for those that draw letters themselves.

use super::style::{LARGE, NUMBER, SAID, SMALL};

/// How a line of text is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lettering {
    /// Letter size.
    pub(crate) size: f64,
    pub(crate) bold: bool,
    /// Whether its place is its middle; otherwise where it begins.
    pub(crate) centred: bool,
}

impl Lettering {
    /// Of a text of these classes.
    pub(crate) fn of(classes: &str) -> Self {
        let mut lettering = Self { size: SMALL, bold: false, centred: false };
        for class in classes.split_ascii_whitespace() {
            match class {
                "title" => lettering.size = LARGE,
                "said" => lettering.size = SAID,
                "number" => lettering.size = NUMBER,
                _ => {}
            }
            lettering.bold |= matches!(class, "title" | "alert" | "strong" | "end" | "number");
            lettering.centred |= matches!(class, "id" | "end" | "mid" | "number");
        }
        lettering
    }
}

#[cfg(test)]
mod tests {
    use super::Lettering;
    use crate::picture::style::SHEET;

    #[test]
    fn it_is_what_the_style_sheet_says() {
        let mut compared = 0;
        for (selectors, declarations) in SHEET.split('}').filter_map(|rule| rule.trim().split_once('{')) {
            for class in selectors.split(',').filter_map(|selector| selector.strip_prefix('.')) {
                let (lettering, plain) = (Lettering::of(class), Lettering::of(""));
                // Several rules may speak of one class: what one says must hold.
                for declaration in declarations.split(';') {
                    let holds = match declaration.split_once(':') {
                        Some(("font-size", size)) => size == format!("{}px", lettering.size),
                        Some(("font-weight", "bold")) => lettering.bold,
                        Some(("text-anchor", "middle")) => lettering.centred,
                        _ => continue,
                    };
                    assert!(holds, "{class}: {declaration}");
                    compared += 1;
                }
                let says = |what: &str| {
                    SHEET.split('}').filter_map(|rule| rule.trim().split_once('{')).any(
                        |(selectors, declared)| {
                            selectors.split(',').any(|each| each == format!(".{class}"))
                                && declared.contains(what)
                        },
                    )
                };
                assert!(lettering.size == plain.size || says("font-size"), "{class}");
                assert!(!lettering.bold || says("font-weight:bold"), "{class}");
                assert!(!lettering.centred || says("text-anchor:middle"), "{class}");
            }
        }
        assert!(compared >= 10 && SHEET.contains("text{font-family") && SHEET.contains("font-size:21px"));
    }
}
