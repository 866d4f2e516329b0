//! Names by pattern.

/// A name in which `*` stands for any text; upper and lower case are alike.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pattern {
    lower: Vec<char>,
}

impl Pattern {
    /// The pattern `text`. Every text is a pattern.
    pub(crate) fn new(text: &str) -> Self {
        Self { lower: text.to_lowercase().chars().collect() }
    }

    /// Whether `name` fits. Cost: at most length of the pattern times length of the name.
    pub(crate) fn fits(&self, name: &str) -> bool {
        let name: Vec<char> = name.to_lowercase().chars().collect();
        let (mut p, mut n) = (0, 0);
        // Where to go on when the text after the last star does not fit: one character later.
        let mut retry: Option<(usize, usize)> = None;
        while n < name.len() {
            match self.lower.get(p) {
                Some('*') => {
                    retry = Some((p + 1, n));
                    p += 1;
                }
                Some(&c) if c == name[n] => {
                    p += 1;
                    n += 1;
                }
                _ => {
                    let Some((after_star, from)) = retry else { return false };
                    retry = Some((after_star, from + 1));
                    p = after_star;
                    n = from + 1;
                }
            }
        }
        self.lower[p..].iter().all(|&c| c == '*')
    }
}

#[cfg(test)]
mod tests {
    use super::Pattern;

    #[test]
    fn star_stands_for_any_text_and_case_does_not_matter() {
        for (pattern, name, fits) in [
            ("clamps", "CLAMPS", true),
            ("clamps", "CLAMPS2", false),
            ("clamps*", "CLAMPS2", true),
            ("*", "", true),
            ("", "", true),
            ("", "x", false),
            ("a*b*c", "axxbyyc", true),
            ("a*b*c", "axxbyy", false),
            ("*ab", "aab", true),
            ("**a**", "bab", true),
            ("ÄÖ*", "äöü", true),
        ] {
            assert_eq!(Pattern::new(pattern).fits(name), fits, "{pattern} {name}");
        }
    }
}
