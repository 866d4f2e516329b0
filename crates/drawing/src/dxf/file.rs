//! The sections of a file: what is kept of it until it is drawn out.

use super::blocks::{BlockId, Blocks, MODEL};
use super::budget::VertexBudget;
use super::entity::{Entity, Kind, Read, read_entity};
use super::groups::{Group, Groups};
use super::hatch::settle_hatches;
use super::layers::Layers;
use super::record::Record;
use super::sniff::Spelling;
use super::text::TextCoding;
use crate::{LengthUnit, ReadError, ReadOptions, WhyUnused};

/// What a file holds.
#[derive(Debug, Default)]
pub(super) struct File<'a> {
    /// The unit that it names.
    pub(super) unit: Option<LengthUnit>,
    /// Layers, from their table and from entities.
    pub(super) layers: Layers<'a>,
    /// Blocks; the first is the model.
    pub(super) blocks: Blocks,
    coding: TextCoding,
}

/// Reads a whole file. What is kept takes no more than the options allow.
pub(super) fn read_file<'a>(
    bytes: &'a [u8],
    spelling: Spelling,
    options: &ReadOptions,
) -> Result<File<'a>, ReadError> {
    let mut reader = Reader {
        groups: Groups::new(bytes, spelling),
        file: File::default(),
        entities_left: options.entity_limit,
        entity_limit: options.entity_limit,
        vertices: VertexBudget::new(options.vertex_limit),
    };
    loop {
        let group = reader.groups.next_group()?;
        if group.opens("EOF") {
            break;
        }
        if group.opens("SECTION") {
            let name = reader.groups.next_group()?;
            match (name.code, name.value) {
                (2, b"HEADER") => reader.header()?,
                (2, b"TABLES") => reader.tables()?,
                (2, b"BLOCKS") => reader.blocks()?,
                (2, b"ENTITIES") => reader.entities()?,
                (2, _) => while reader.next_record()?.is_some() {},
                _ => return Err(name.unexpected("the name of a section")),
            }
        } else if group.code == 0 {
            return Err(group.unexpected("SECTION"));
        }
    }
    let mut file = reader.file;
    file.blocks.iter_mut().for_each(settle_hatches);
    Ok(file)
}

struct Reader<'a> {
    groups: Groups<'a>,
    file: File<'a>,
    entities_left: usize,
    entity_limit: usize,
    vertices: VertexBudget,
}

impl<'a> Reader<'a> {
    /// The first group of the next record of this section; none at its end.
    fn next_record(&mut self) -> Result<Option<Group<'a>>, ReadError> {
        loop {
            let group = self.groups.next_group()?;
            if group.opens("ENDSEC") {
                return Ok(None);
            } else if group.opens("EOF") || group.opens("SECTION") {
                return Err(group.unexpected("ENDSEC"));
            } else if group.code == 0 {
                return Ok(Some(group));
            }
        }
    }

    fn header(&mut self) -> Result<(), ReadError> {
        let mut variable: &[u8] = b"";
        while let Some(group) = self.groups.next_in_record()? {
            match (group.code, variable) {
                (9, _) => variable = group.value,
                (70, b"$INSUNITS") => {
                    let code = i16::try_from(group.integer()?).ok();
                    self.file.unit = code.and_then(LengthUnit::from_insunits);
                }
                (3, b"$DWGCODEPAGE") => self.file.coding = TextCoding::of_code_page(group.value),
                _ => {}
            }
        }
        match self.next_record()? {
            None => Ok(()),
            Some(group) => Err(group.unexpected("ENDSEC")),
        }
    }

    fn tables(&mut self) -> Result<(), ReadError> {
        while let Some(opening) = self.next_record()? {
            if !opening.opens("LAYER") {
                continue;
            }
            let mut record = Record::new(&mut self.groups);
            let mut name = None;
            while let Some(group) = record.next_group()? {
                if group.code == 2 {
                    name = Some(group.value);
                }
            }
            let color = record.finish()?.color;
            if let Some(name) = name {
                let id = self.file.layers.id_of(name, self.file.coding);
                self.file.layers.set_color(id, color);
            }
        }
        Ok(())
    }

    fn blocks(&mut self) -> Result<(), ReadError> {
        let mut place = None;
        while let Some(opening) = self.next_record()? {
            if opening.opens("BLOCK") {
                place = Some(self.block()?);
            } else if opening.opens("ENDBLK") {
                place = None;
            } else if let Some(place) = place {
                self.entity(&opening, place)?;
            } else {
                return Err(opening.unexpected("BLOCK"));
            }
        }
        Ok(())
    }

    /// Reads the head of a block; says where its entities belong.
    fn block(&mut self) -> Result<Place, ReadError> {
        let mut record = Record::new(&mut self.groups);
        let (mut name, mut base, mut flags): (&[u8], _, _) = (b"", traverse_geometry::Point::origin(), 0);
        while let Some(group) = record.next_group()? {
            match group.code {
                2 => name = group.value,
                10 => base.x = group.real()?,
                20 => base.y = group.real()?,
                70 => flags = group.integer()?,
                _ => {}
            }
        }
        let name = self.file.coding.decode(name);
        let lower = name.to_lowercase();
        // The model and the sheets; R12 writes $.
        let space = lower.strip_prefix(['*', '$']).unwrap_or_default();
        if space == "model_space" {
            return Ok(Place::In(MODEL));
        }
        if space.starts_with("paper_space") {
            return Ok(Place::Sheet);
        }
        let id = self.file.blocks.id_of(&name);
        let block = self.file.blocks.get_mut(id);
        if block.known {
            // As CAD programs do, the first definition counts.
            return Ok(Place::Nowhere);
        }
        block.name = name;
        block.base = base;
        block.known = flags & EXTERNAL == 0;
        Ok(Place::In(id))
    }

    fn entities(&mut self) -> Result<(), ReadError> {
        while let Some(opening) = self.next_record()? {
            self.entity(&opening, Place::In(MODEL))?;
        }
        Ok(())
    }

    fn entity(&mut self, opening: &Group<'a>, place: Place) -> Result<(), ReadError> {
        // The end of an INSERT's attributes.
        if opening.opens("SEQEND") {
            return Ok(());
        }
        let limit = self.entity_limit;
        self.entities_left = self.entities_left.checked_sub(1).ok_or(ReadError::TooManyEntities { limit })?;
        let name = String::from_utf8_lossy(opening.value).to_ascii_uppercase();
        let record = Record::new(&mut self.groups);
        let File { blocks, coding, layers, .. } = &mut self.file;
        let Read { head, mut kind } = read_entity(&name, record, blocks, *coding, &mut self.vertices)?;
        let id = match place {
            Place::In(id) => id,
            Place::Sheet => {
                kind = Kind::Unused(name.into(), WhyUnused::PaperSpace);
                MODEL
            }
            Place::Nowhere => return Ok(()),
        };
        let layer = layers.id_of(head.layer, *coding);
        let entity = Entity { layer, color: head.color, line: opening.line, handle: head.handle, kind };
        blocks.get_mut(id).entities.push(entity);
        Ok(())
    }
}

/// Group 70 of a BLOCK: it lies in another file.
const EXTERNAL: i64 = 4;

/// Where entities belong.
#[derive(Clone, Copy, Debug)]
enum Place {
    /// In that block or the model.
    In(BlockId),
    /// On a layout sheet: they are counted.
    Sheet,
    /// In a block that is defined once more: they are not counted.
    Nowhere,
}
