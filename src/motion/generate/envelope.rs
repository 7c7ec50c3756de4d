//! How strongly a stationary process is let through over time.

use crate::math::exp;
use crate::motion::fault::Faults;

/// A factor over time between 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(tag = "envelope", rename_all = "snake_case")]
pub enum Envelope {
    /// 1 throughout.
    Constant,
    /// `(t/rise)^2` at first, then 1, and `exp(-decay (t - fall))` from `fall` on (Jennings, Housner and Tsai 1968).
    RiseAndDecay {
        /// End of the rise (s).
        rise: f64,
        /// Beginning of the decay (s).
        fall: f64,
        /// Rate of the decay (1/s).
        decay: f64,
    },
}

impl Envelope {
    /// At a time (s) from the beginning.
    pub fn at(&self, time: f64) -> f64 {
        match *self {
            Envelope::RiseAndDecay { rise, .. } if time < rise => (time / rise) * (time / rise),
            Envelope::RiseAndDecay { fall, decay, .. } if time > fall => exp(-decay * (time - fall)),
            _ => 1.0,
        }
    }

    pub(super) fn require(&self, faults: &mut Faults) {
        if let Envelope::RiseAndDecay { rise, fall, decay } = *self {
            faults.require((0.0..=1e4).contains(&rise), "rise (s)", rise, "0 to 10,000 s");
            faults.require(
                fall >= rise && fall <= 1e4,
                "fall (s)",
                fall,
                "from the end of the rise to 10,000 s",
            );
            faults.require((0.0..=1e3).contains(&decay), "decay (1/s)", decay, "0 to 1000/s");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rises_stays_and_decays() {
        let envelope = Envelope::RiseAndDecay { rise: 2.0, fall: 5.0, decay: 0.5 };
        let found = [0.0, 1.0, 2.0, 4.0, 5.0, 7.0].map(|t| envelope.at(t));
        assert_eq!(found, [0.0, 0.25, 1.0, 1.0, 1.0, exp(-1.0)]);
        assert_eq!(Envelope::RiseAndDecay { rise: 0.0, fall: 5.0, decay: 0.5 }.at(0.0), 1.0);
        assert_eq!(Envelope::Constant.at(3.0), 1.0);
    }
}
