//! What can be done to a campaign in secret: to the study, the wall, its joints, what holds it, the platform, the gauges, the
//! readers.

use pirca::law::Coulomb;
use pirca::math::Vec3;
use pirca::model::Wall;
use pirca::protocol::Restraint;
use pirca::random::standard_normal::quantile;
use pirca::random::{Stream, Streams};
use pirca::study::Study;

use super::readings::{Entry, Series};

/// Something that is hidden. Each of its sides does nothing unless it says otherwise. Draws of a specimen come from its streams.
pub trait Effect: Send + Sync {
    /// The study that walls are drawn from.
    fn study(&self, study: Study) -> Study {
        study
    }

    /// A wall as built.
    fn wall(&self, wall: Wall, _streams: &Streams) -> Wall {
        wall
    }

    /// The law of a joint.
    fn law(&self, law: Coulomb, _place: &Place, _streams: &Streams) -> Coulomb {
        law
    }

    /// What holds the wall.
    fn restraint(&self, restraint: Restraint) -> Restraint {
        restraint
    }

    /// Whether it makes walls differ that are alike in their stones and joints.
    fn differs(&self) -> bool {
        false
    }

    /// The tilt (rad) at which the wall truly is where the platform shows another one.
    fn tilt(&self, shown: f64) -> f64 {
        shown
    }

    /// The other way round: the tilt (rad) that the platform shows.
    fn shown(&self, tilt: f64) -> f64 {
        tilt
    }

    /// What gauges show of a specimen.
    fn read(&self, _series: &mut Series, _specimen: &Specimen) {}

    /// The error of a reading in its standard deviations; `None` where it is normal.
    fn error(&self, _stream: &mut Stream) -> Option<f64> {
        None
    }

    /// The rows as they are written down.
    fn rows(&self, _rows: &mut [Entry], _stream: &mut Stream) {}
}

/// A specimen among those of its campaign.
pub struct Specimen {
    /// Its number, from 0.
    pub number: u64,
    /// Its place in the order of the tests, from 1.
    pub order: u32,
    /// Its own draws.
    pub streams: Streams,
}

/// Where a joint lies.
pub struct Place {
    /// Its blocks, the lower number first; the wall's own come first.
    pub blocks: [u32; 2],
    /// Lowest and highest corner of what the two blocks' boxes share (m); on the platform that is the stone's underside.
    pub shared: [Vec3; 2],
    /// Lowest and highest corner of the wall (m).
    pub wall: [Vec3; 2],
    /// Whether one of the blocks is not the wall's.
    pub on_platform: bool,
}

impl Place {
    /// Its middle (m).
    pub fn middle(&self) -> Vec3 {
        (self.shared[0] + self.shared[1]) * 0.5
    }

    /// Whether it stands upright between stones of a course.
    pub fn is_head(&self) -> bool {
        let extent = self.shared[1] - self.shared[0];
        !self.on_platform && extent.x < extent.z
    }

    /// Distance of its middle from the nearer end of the wall (m).
    pub fn to_nearer_end(&self) -> f64 {
        let x = self.middle().x;
        (x - self.wall[0].x).min(self.wall[1].x - x)
    }

    /// A draw of its own.
    pub fn uniform(&self, streams: &Streams, name: &str) -> f64 {
        let [a, b] = self.blocks;
        streams.of(&format!("hidden {name} {a}-{b}")).uniform()
    }
}

/// A standard normal draw.
pub fn normal(stream: &mut Stream) -> f64 {
    quantile(stream.uniform())
}
