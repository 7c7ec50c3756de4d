//! Numbers in the buffers of a glTF file: accessors, which look at buffer views, which look at buffers.

use crate::exchange::fault::Fault;
use crate::exchange::mesh::gltf::buffers::{Bytes, Missing};
use crate::exchange::mesh::gltf::document::{Accessor, Document, PLAIN};
use crate::exchange::mesh::{AGAIN, quoted, refusal};
use crate::math::Vec3;

/// What the numbers of an accessor must be.
pub(super) struct Kind {
    /// What they are called in faults.
    what: &'static str,
    /// The type of their items.
    name: &'static str,
    /// How many numbers an item has.
    width: u64,
    /// The codes of the kinds of numbers, each with its size in bytes.
    components: &'static [(u64, u64)],
}

/// Corners, of single precision.
pub(super) const POSITIONS: Kind =
    Kind { what: "positions", name: "VEC3", width: 3, components: &[(5126, 4)] };
/// The corners of triangles, as whole numbers of 8, 16 or 32 bits.
pub(super) const INDICES: Kind =
    Kind { what: "indices", name: "SCALAR", width: 1, components: &[(5121, 1), (5123, 2), (5125, 4)] };

/// A description with its buffers, or with what is wrong with each of these and how to mend it.
pub(super) struct File<'a> {
    pub document: Document,
    pub buffers: Vec<Bytes<'a>>,
}

impl File<'_> {
    /// The numbers of an accessor; faults are those of the mesh with this title.
    ///
    /// # Errors
    /// Numbers of another kind, or sparse, or compressed, or not within their bytes.
    pub fn numbers(&self, number: usize, title: &str, kind: &Kind) -> Result<Numbers<'_>, Box<Fault>> {
        let Kind { what, name: kind, width, components } = kind;
        let wrong = |found: String, allowed: &str, fix: &str| {
            refusal(title, format!("its {what} {found}"), allowed, fix)
        };
        let missing = |what: &str, number: usize, count: usize| {
            wrong(format!("are in {what} {number}, and there are {count}"), "numbers from 0", AGAIN)
        };
        let accessors = &self.document.accessors;
        let own = accessors.get(number).ok_or_else(|| missing("accessor", number, accessors.len()))?;
        let Some((_, size)) =
            components.iter().find(|(code, _)| *code == own.component_type && own.kind == *kind)
        else {
            let found = format!("are of the kind {} ({})", quoted(own.kind.as_bytes()), own.component_type);
            let codes: Vec<String> = components.iter().map(|(code, _)| code.to_string()).collect();
            return Err(wrong(found, &format!("{kind} of {}", codes.join(", ")), PLAIN));
        };
        let size = width * size;
        let view = match own {
            Accessor { sparse: Some(_), .. } => Err("are sparse".to_owned()),
            Accessor { buffer_view: None, .. } => Err("are in no buffer".to_owned()),
            Accessor { buffer_view: Some(view), .. } => Ok(*view),
        };
        let view = view.map_err(|found| wrong(found, "numbers in a buffer", PLAIN))?;
        let views = &self.document.buffer_views;
        let view = views.get(view).ok_or_else(|| missing("buffer view", view, views.len()))?;
        if let Some(extension) = view.compression() {
            return Err(wrong(format!("are compressed ({extension})"), "numbers in a buffer", PLAIN));
        }
        let buffer = self.buffers.get(view.buffer);
        let buffer = buffer.ok_or_else(|| missing("buffer", view.buffer, self.buffers.len()))?;
        let buffer = buffer.as_ref().map_err(|Missing { found, fix }| {
            wrong(format!("are not there: {found}"), "whole buffers in the file or beside it", fix)
        })?;
        let stride = view.byte_stride.unwrap_or(size);
        if stride < size || own.count == 0 {
            let found = format!("are {} items, one every {stride} bytes", own.count);
            return Err(wrong(found, &format!("at least one, every {size} bytes or more"), AGAIN));
        }
        let length = (own.count - 1).checked_mul(stride).and_then(|own| own.checked_add(size));
        let bytes = within(buffer, view.byte_offset, Some(view.byte_length))
            .and_then(|bytes| within(bytes, own.byte_offset, length));
        let bytes = bytes.ok_or_else(|| {
            let found = format!("reach beyond their bytes: {} items of {size} bytes", own.count);
            wrong(found, "accessors within their buffer views, and these within their buffers", AGAIN)
        })?;
        Ok(Numbers { bytes, stride: stride as usize, size: size as usize, count: own.count })
    }
}

/// So many bytes from an offset, where there are as many.
fn within(bytes: &[u8], offset: u64, length: Option<u64>) -> Option<&[u8]> {
    let end = offset.checked_add(length?)?;
    bytes.get(usize::try_from(offset).ok()?..usize::try_from(end).ok()?)
}

/// Items of equal size in bytes.
pub(super) struct Numbers<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    /// How many there are.
    pub count: u64,
}

impl Numbers<'_> {
    /// The bytes of each.
    pub fn items(&self) -> impl Iterator<Item = &[u8]> {
        self.bytes.chunks(self.stride).map(|own| &own[..self.size])
    }
}

/// A whole number of up to four bytes.
pub(super) fn whole(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte))
}

/// A position of single precision.
pub(super) fn position(bytes: &[u8]) -> Vec3 {
    let number = |at: usize| f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
    Vec3::new(number(0).into(), number(4).into(), number(8).into())
}
