//! TSPLIB files: formats, and what is said of files that can't be read.

use proptest::prelude::*;
use traverse_tours::{Costs, FORBIDDEN, Shape, read_tsplib};

fn file(head: &str, weights: &str) -> String {
    format!("NAME: test\n{head}\nEDGE_WEIGHT_TYPE: EXPLICIT\nEDGE_WEIGHT_SECTION\n{weights}\nEOF\n")
}

#[test]
fn formats_say_the_same_matrix() {
    for (format, weights) in [
        ("FULL_MATRIX", "0 1 2\n1 0 3\n\n2 3 0"),
        ("UPPER_ROW", "1 2 3"),
        ("LOWER_ROW", "1\n2 3"),
        ("UPPER_DIAG_ROW", "0 1 2 0 3 0"),
        ("LOWER_DIAG_ROW", "0 1 0 2 3 0"),
    ] {
        let text = file(&format!("TYPE: TSP\nDIMENSION: 3\nEDGE_WEIGHT_FORMAT: {format}"), weights);
        let specification = read_tsplib(&text).expect(format);
        let costs = &specification.costs;
        assert_eq!([costs.cost(0, 1), costs.cost(2, 0), costs.cost(1, 2)], [1, 2, 3], "{format}");
        assert_eq!((costs.cost(1, 1), specification.shape), (FORBIDDEN, Shape::Cycle));
    }
}

#[test]
fn minus_one_in_a_sequential_ordering_is_an_order() {
    let weights = "4\n0 5 6 9\n-1 0 3 4\n-1 -1 0 7\n-1 -1 -1 0";
    let text = file("TYPE: SOP\nDIMENSION: 4\nEDGE_WEIGHT_FORMAT: FULL_MATRIX", weights);
    let specification = read_tsplib(&text).expect("a valid file");
    assert_eq!(
        (specification.first, specification.last, specification.shape),
        (Some(0), Some(3), Shape::Path)
    );
    assert_eq!(specification.precedence, [(1, 2)]);
}

#[test]
fn what_is_wrong_is_said_with_its_line() {
    let head = "TYPE: ATSP\nDIMENSION: 2\nEDGE_WEIGHT_FORMAT: FULL_MATRIX";
    for (text, message) in [
        (
            file("TYPE: ATSP\nDIMENSION: two", "1"),
            "line 3: DIMENSION is \"two\": use a whole number from 1 to 5000",
        ),
        (file("TYPE: CVRP", "1"), "line 2: TYPE is \"CVRP\": use ATSP, SOP or TSP"),
        (file(head, "0 1\nx 0"), ""),
        (
            file(head, "0 1\n1.5 0"),
            "line 8: a weight is \"1.5\": use whole numbers of at most 100 000 000 000 either way",
        ),
        (file(head, "0 1 1"), "EDGE_WEIGHT_SECTION has 3 numbers: 4 for this dimension and format"),
        (file(head, "0 1 1 0 0 0 0"), "EDGE_WEIGHT_SECTION has 6 numbers: 4 for this dimension and format"),
        (String::new(), "EDGE_WEIGHT_SECTION is missing: only explicit weights can be read"),
        (file("DIMENSION: 3\nTYPE: SOP\nEDGE_WEIGHT_FORMAT: FULL_MATRIX", "0 1 1 -1 0 -1 -1 -1 0"), ""),
    ] {
        match read_tsplib(&text) {
            Err(error) => assert!(message.is_empty() || error.to_string() == message, "{error}"),
            Ok(_) => assert!(message.is_empty(), "{text}"),
        }
    }
}

proptest! {
    /// Any change of any bytes gives a specification or an error, never a panic.
    #[test]
    fn mutated_files_are_read_or_refused(cuts in prop::collection::vec((0_usize..200, any::<u8>(), 0_usize..4), 0..12)) {
        let weights = "4\n0 5 6 9\n-1 0 3 4\n-1 -1 0 7\n-1 -1 -1 0";
        let text = file("TYPE: SOP\nDIMENSION: 4\nEDGE_WEIGHT_FORMAT: FULL_MATRIX", weights);
        let mut bytes = text.into_bytes();
        for (at, byte, kind) in cuts {
            let at = at % bytes.len().max(1);
            match kind {
                0 if at < bytes.len() => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                2 if at < bytes.len() => { bytes.remove(at); }
                _ => bytes.truncate(at + 60),
            }
        }
        if let Ok(specification) = read_tsplib(&String::from_utf8_lossy(&bytes)) {
            prop_assert!(specification.findings().is_empty());
        }
    }
}
