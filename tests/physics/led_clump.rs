//! Shear of a joint in a heap: one body is led over others that are held, under its own weight.

use pirca::math::{Vec3, atan};
use pirca::model::Heap;
use pirca::solve::Status;
use pirca::solve::bodies::Freedom;
use pirca::solve::grains;

/// Looks at the body per reading: the force of a reading is their mean.
const LOOKS: u32 = 20;

/// How a body is led.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slide {
    /// The clump that is led; it moves up and down freely, and does not turn.
    pub body: usize,
    /// Speed along x (m/s), above 0. It must be small beside `sqrt(g d)`, d being the closure of the joint under the weight: the body rings
    /// where the slope changes at once, and local damping, which looks at the sign of the velocity only, takes nothing from a
    /// ringing slower than the body's own rise. At a tenth of it forces came out 1 to 4 % too high on slopes of up to
    /// 30 degrees, at a fiftieth up to 1 %.
    pub speed: f64,
    /// How far it is led (m).
    pub way: f64,
    /// Number of readings along the way.
    pub readings: u32,
    /// Unbalanced force ratio at which it is at rest before it is led.
    pub rest_ratio: f64,
}

/// What is read on the way.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct SlideReading {
    /// How far it has come (m).
    pub way: f64,
    /// Shear force over weight: what resists, positive against the motion.
    pub ratio: f64,
    /// How far it has risen since it was at rest (m).
    pub rise: f64,
}

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Slid {
    /// How it came to rest before it was led; without [`Status::Equilibrium`] there are no readings.
    pub rest: Status,
    /// Closure (m) under the weight: how far it sank to come to rest, from where the heap has it.
    pub sunk: f64,
    /// The readings, evenly along the way.
    pub readings: Vec<SlideReading>,
    /// Time steps taken.
    pub steps: u64,
}

impl Slid {
    /// The largest ratio of shear to weight; 0 without readings.
    pub fn peak(&self) -> f64 {
        self.readings.iter().map(|r| r.ratio).fold(0.0, f64::max)
    }

    /// The mean ratio from a way (m) to the end, over whole readings; NaN where there are none.
    pub fn mean_from(&self, way: f64) -> f64 {
        let ratios: Vec<f64> = self.readings.iter().filter(|r| r.way > way).map(|r| r.ratio).collect();
        ratios.iter().sum::<f64>() / ratios.len() as f64
    }

    /// Largest dilatancy angle (rad): the steepest rise between readings.
    pub fn dilatancy(&self) -> f64 {
        let slope = |pair: &[SlideReading]| (pair[1].rise - pair[0].rise) / (pair[1].way - pair[0].way);
        atan(self.readings.windows(2).map(slope).fold(0.0, f64::max))
    }

    /// Difference of its highest and its lowest place (m): of the readings, and at rest.
    pub fn rise(&self) -> f64 {
        let of = |pick: fn(f64, f64) -> f64| self.readings.iter().map(|r| r.rise).fold(0.0, pick);
        of(f64::max) - of(f64::min)
    }
}

/// Lets the body come to rest where it is, and leads it along x at a constant speed.
///
/// From rest on it cannot move but up and down: what pushes it sideways is read, not followed. Before, too, so that it keeps its
/// place in the hollows or on the crests.
pub fn slide(heap: &Heap, settings: grains::Settings, slide: &Slide) -> Slid {
    let mut simulation = grains::Simulation::new(heap, settings);
    let id = slide.body;
    let laid = simulation.grains.bodies[id].position;
    simulation.grains.bodies[id].freedom = Freedom::Led;
    // Sideways forces balance each other only by symmetry: what counts is the force up and down.
    let weight = simulation.grains.bodies[id].mass * simulation.grains.gravity.norm();
    let mut rest = Status::StepsSpent;
    for step in 1..=settings.max_steps {
        simulation.step();
        let body = &simulation.grains.bodies[id];
        if !simulation.grains.is_finite() {
            rest = Status::NonFinite;
            break;
        }
        // It bears on something, and neither its force nor its motion is worth speaking of.
        let moving = body.mass * body.velocity.z.abs() / simulation.dt;
        if step > 10 && body.force.z.abs().max(moving) < slide.rest_ratio * weight {
            rest = Status::Equilibrium;
            break;
        }
    }
    let start = simulation.grains.bodies[id].position;
    let mut slid = Slid { rest, sunk: laid.z - start.z, readings: Vec::new(), steps: simulation.steps };
    if rest != Status::Equilibrium {
        return slid;
    }
    simulation.grains.bodies[id].velocity = Vec3::x() * slide.speed;
    for reading in 0..slide.readings {
        let (mut way, mut ratio, mut rise) = (0.0, 0.0, 0.0);
        for look in 0..LOOKS {
            let share =
                (f64::from(reading) + f64::from(look + 1) / f64::from(LOOKS)) / f64::from(slide.readings);
            while simulation.grains.bodies[id].position.x - start.x < slide.way * share {
                simulation.step();
            }
            let body = &simulation.grains.bodies[id];
            way += body.position.x - start.x;
            ratio -= body.force.x / weight;
            rise += body.position.z - start.z;
        }
        let of = |sum: f64| sum / f64::from(LOOKS);
        slid.readings.push(SlideReading { way: of(way), ratio: of(ratio), rise: of(rise) });
    }
    slid.steps = simulation.steps;
    slid
}
