//! What a design can tell, and which measurement would tell more.

mod detection_limit;
mod information;
mod menu;
mod next;
mod self_test;
#[cfg(test)]
mod tests;

pub use detection_limit::{DETECTION_POWER, DetectionLimit};
pub use menu::Offer;
pub use next::{Offered, offers};
pub use self_test::{Counted, SelfTest, SelfTestRow};
