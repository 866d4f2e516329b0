//! Style sheets of `<style>` elements: rules for types, classes, ids and their combinations, such as
//! `path.cut, #clamp`. Rules whose selectors look at other elements or at states are counted, not read.

use super::element::Element;
use std::collections::HashMap;

/// Selectors of a simple kind in a sheet.
#[derive(Debug)]
pub(super) struct StyleSheet<'a> {
    rules: Vec<Rule<'a>>,
    by_key: HashMap<(Kind, &'a str), Vec<usize>>,
    /// Selectors that were not read.
    pub(super) unread: usize,
}

/// A selector and what it declares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rule<'a> {
    selector: &'a str,
    /// `name: value; …`
    pub(super) declarations: &'a str,
    /// Count of ids, of classes and of types.
    weight: (usize, usize, usize),
}

/// What a part of a selector names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Kind {
    Any,
    Type,
    Class,
    Id,
}

impl<'a> StyleSheet<'a> {
    /// The sheet of a text without comments. Rules within `@media` and other at-rules are not read.
    pub(super) fn parse(text: &'a str) -> Self {
        let mut sheet = Self { rules: Vec::new(), by_key: HashMap::new(), unread: 0 };
        let mut rest = text;
        while let Some((head, after)) = rest.split_once('{') {
            // At-rules without a block, such as @import, end with a semicolon.
            let head = head.rsplit(';').next().unwrap_or_default().trim();
            let end = if head.starts_with('@') { block_end(after) } else { after.find('}') };
            let end = end.unwrap_or(after.len());
            if head.starts_with('@') {
                sheet.unread += 1;
            } else {
                for selector in head.split(',') {
                    sheet.add(selector.trim(), &after[..end]);
                }
            }
            rest = after.get(end + 1..).unwrap_or_default();
        }
        sheet
    }

    fn add(&mut self, selector: &'a str, declarations: &'a str) {
        let Some(parts) = parts(selector) else {
            self.unread += 1;
            return;
        };
        let count = |kind| parts.iter().filter(|part| part.0 == kind).count();
        let weight = (count(Kind::Id), count(Kind::Class), count(Kind::Type));
        // Filed under its rarest part.
        if let Some(&key) = parts.iter().max_by_key(|part| part.0 as u8) {
            self.by_key.entry(key).or_default().push(self.rules.len());
            self.rules.push(Rule { selector, declarations, weight });
        }
    }

    /// The rules that fit an element, the weakest first, and how many were looked at.
    pub(super) fn rules_for(&self, element: &Element<'_>) -> (Vec<Rule<'a>>, usize) {
        if self.rules.is_empty() {
            return (Vec::new(), 0);
        }
        let mut classes: Vec<_> = element.attribute("class").unwrap_or_default().split_whitespace().collect();
        classes.sort_unstable();
        classes.dedup();
        let keys = classes
            .iter()
            .map(|&class| (Kind::Class, class))
            .chain(element.id().map(|id| (Kind::Id, id)))
            .chain([(Kind::Type, element.tag()), (Kind::Any, "*")]);
        let filed: Vec<_> =
            keys.filter_map(|(kind, name)| self.by_key.get(&(kind, name))).flatten().collect();
        let fits = |at: usize| {
            parts(self.rules[at].selector).unwrap_or_default().iter().all(|&(kind, name)| match kind {
                Kind::Any => true,
                Kind::Type => element.tag() == name,
                Kind::Class => classes.binary_search(&name).is_ok(),
                Kind::Id => element.id() == Some(name),
            })
        };
        let mut found: Vec<usize> = filed.iter().map(|&&at| at).filter(|&at| fits(at)).collect();
        found.sort_unstable_by_key(|&at| (self.rules[at].weight, at));
        (found.into_iter().map(|at| self.rules[at]).collect(), filed.len())
    }
}

/// Where a block ends that may hold blocks.
fn block_end(text: &str) -> Option<usize> {
    let mut depth = 1;
    text.bytes().position(|byte| {
        depth += i32::from(byte == b'{') - i32::from(byte == b'}');
        depth == 0
    })
}

/// Most parts of a selector that is read.
const MOST_PARTS: usize = 8;

/// What a selector such as `path.cut#a` names; none for other kinds of selectors.
fn parts(selector: &str) -> Option<Vec<(Kind, &str)>> {
    let mut parts = Vec::new();
    let mut rest = selector;
    while let Some(first) = rest.chars().next() {
        let kind = match first {
            '.' => Kind::Class,
            '#' => Kind::Id,
            '*' if parts.is_empty() => Kind::Any,
            _ if parts.is_empty() => Kind::Type,
            _ => return None,
        };
        let name_at = usize::from(matches!(kind, Kind::Class | Kind::Id));
        let body = &rest[name_at..];
        let end = body.find(['.', '#']).unwrap_or(body.len());
        let (name, after) = body.split_at(end);
        let plain = name.chars().all(|c| c.is_alphanumeric() || c == '-' || c == '_');
        if name.is_empty() || parts.len() == MOST_PARTS || !(plain || kind == Kind::Any && name == "*") {
            return None;
        }
        parts.push((kind, name));
        rest = after;
    }
    (!parts.is_empty()).then_some(parts)
}

/// A text without its comments.
pub(super) fn without_comments(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("/*") {
        plain.push_str(before);
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    plain.push_str(rest);
    plain
}
