//! `analyse --verify`: the wall's mechanism checked as a code asks for it.

mod figure;
mod mechanism;
mod over;
mod said;
mod work;

pub(crate) use said::Verification;
pub(crate) use work::{refused, site, verified};
