//! What an R2000 file needs round its entities: header, tables, blocks, root dictionary.
//!
//! Source: Autodesk, DXF Reference, AutoCAD 2000. Handles are given in the order of writing; the header's seed is
//! filled in at the end.

use super::groups::Groups;
use traverse_geometry::{Bounds, Point};

/// Stands in the header until the last handle is known.
const SEED_MARK: &str = "HANDSEED-MARK";

/// A layer of the file.
pub(crate) struct FileLayer {
    pub(crate) name: &'static str,
    /// AutoCAD colour index.
    pub(crate) color: u8,
    /// Hundredths of a millimetre.
    pub(crate) lineweight: u8,
}

/// Writes everything up to the first entity; gives the owner of entities in model space.
pub(crate) fn begin_file(groups: &mut Groups, layers: &[FileLayer], bounds: Bounds) -> u32 {
    header(groups, bounds);
    section(groups, "TABLES");
    viewport(groups, bounds);
    table(groups, "LTYPE", "AcDbLinetypeTableRecord", &["ByBlock", "ByLayer", "Continuous"], |groups, _| {
        groups.add(3, "");
        groups.add(72, 65);
        groups.add(73, 0);
        groups.number(40, 0.0);
    });
    let names: Vec<&str> = std::iter::once("0").chain(layers.iter().map(|layer| layer.name)).collect();
    table(groups, "LAYER", "AcDbLayerTableRecord", &names, |groups, name| {
        let layer = layers.iter().find(|layer| layer.name == name);
        groups.add(62, layer.map_or(7, |layer| layer.color));
        groups.add(6, "Continuous");
        groups.add(370, layer.map_or(-3, |layer| i32::from(layer.lineweight)));
    });
    table(groups, "STYLE", "AcDbTextStyleTableRecord", &["Standard"], |groups, _| {
        groups.number(40, 0.0);
        groups.number(41, 1.0);
        groups.number(50, 0.0);
        groups.add(71, 0);
        groups.number(42, 2.5);
        groups.add(3, "txt");
        groups.add(4, "");
    });
    table(groups, "VIEW", "", &[], |_, _| {});
    table(groups, "UCS", "", &[], |_, _| {});
    table(groups, "APPID", "AcDbRegAppTableRecord", &["ACAD"], |_, _| {});
    table(groups, "DIMSTYLE", "AcDbDimStyleTableRecord", &["Standard"], |_, _| {});
    let records =
        table(groups, "BLOCK_RECORD", "AcDbBlockTableRecord", &["*Model_Space", "*Paper_Space"], |_, _| {});
    groups.add(0, "ENDSEC");
    blocks(groups, &records);
    section(groups, "ENTITIES");
    records.first().copied().unwrap_or_default()
}

/// Writes everything after the last entity; gives the file.
pub(crate) fn end_file(mut groups: Groups) -> String {
    groups.add(0, "ENDSEC");
    section(&mut groups, "OBJECTS");
    let (root, named) = (groups.new_handle(), groups.new_handle());
    groups.object("DICTIONARY", root, 0);
    groups.add(100, "AcDbDictionary");
    groups.add(281, 1);
    groups.add(3, "ACAD_GROUP");
    groups.add(350, format_args!("{named:X}"));
    groups.object("DICTIONARY", named, root);
    groups.add(100, "AcDbDictionary");
    groups.add(281, 1);
    groups.add(0, "ENDSEC");
    groups.add(0, "EOF");
    let seed = format!("{:X}", groups.last_handle() + 1);
    groups.into_text(SEED_MARK, &seed)
}

fn section(groups: &mut Groups, name: &str) {
    groups.add(0, "SECTION");
    groups.add(2, name);
}

fn header(groups: &mut Groups, bounds: Bounds) {
    section(groups, "HEADER");
    groups.add(9, "$ACADVER");
    groups.add(1, "AC1015");
    groups.add(9, "$DWGCODEPAGE");
    groups.add(3, "ANSI_1252");
    groups.add(9, "$HANDSEED");
    groups.add(5, SEED_MARK);
    for (name, value) in [("$INSUNITS", 4), ("$MEASUREMENT", 1), ("$PDMODE", 34)] {
        groups.add(9, name);
        groups.add(70, value);
    }
    for (name, corner) in [("$EXTMIN", bounds.min), ("$EXTMAX", bounds.max)] {
        groups.add(9, name);
        groups.point(10, corner);
    }
    groups.add(0, "ENDSEC");
}

fn viewport(groups: &mut Groups, bounds: Bounds) {
    table(groups, "VPORT", "AcDbViewportTableRecord", &["*Active"], |groups, _| {
        let size = bounds.max - bounds.min;
        let pairs = [(10, Point::new(0.0, 0.0)), (11, Point::new(1.0, 1.0)), (12, bounds.min + size / 2.0)];
        for (code, p) in pairs {
            groups.number(code, p.x);
            groups.number(code + 10, p.y);
        }
        // Tall enough for the width too, on a screen twice as wide as high.
        groups.number(40, (1.1 * size.y.max(size.x / 2.0)).max(1.0));
        groups.number(41, 2.0);
    });
}

/// Writes a table of named records; gives their handles.
fn table(
    groups: &mut Groups,
    kind: &str,
    class: &str,
    names: &[&str],
    rest: impl Fn(&mut Groups, &str),
) -> Vec<u32> {
    groups.add(0, "TABLE");
    groups.add(2, kind);
    let table = groups.new_handle();
    groups.add(5, format_args!("{table:X}"));
    groups.add(330, 0);
    groups.add(100, "AcDbSymbolTable");
    groups.add(70, names.len());
    if kind == "DIMSTYLE" {
        groups.add(100, "AcDbDimStyleTable");
        groups.add(71, 0);
    }
    let mut handles = Vec::new();
    for name in names {
        let handle = groups.new_handle();
        groups.object(kind, handle, table);
        groups.add(100, "AcDbSymbolTableRecord");
        groups.add(100, class);
        groups.add(2, name);
        if kind != "BLOCK_RECORD" {
            groups.add(70, 0);
        }
        rest(groups, name);
        handles.push(handle);
    }
    groups.add(0, "ENDTAB");
    handles
}

fn blocks(groups: &mut Groups, records: &[u32]) {
    section(groups, "BLOCKS");
    for (name, &record) in ["*Model_Space", "*Paper_Space"].into_iter().zip(records) {
        let paper = name == "*Paper_Space";
        for kind in ["BLOCK", "ENDBLK"] {
            let handle = groups.new_handle();
            groups.object(kind, handle, record);
            groups.add(100, "AcDbEntity");
            if paper {
                groups.add(67, 1);
            }
            groups.add(8, "0");
            groups.add(100, if kind == "BLOCK" { "AcDbBlockBegin" } else { "AcDbBlockEnd" });
            if kind == "BLOCK" {
                groups.add(2, name);
                groups.add(70, 0);
                groups.point(10, Point::origin());
                groups.add(3, name);
                groups.add(1, "");
            }
        }
    }
    groups.add(0, "ENDSEC");
}
