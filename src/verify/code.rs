//! What codes fix: shares of the displacement at which nothing is borne any more, secant periods, damping, behaviour factor.

/// A limit state checked by displacement.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitState {
    /// Its name.
    pub name: String,
    /// The displacement that it allows, as a share of the one at which nothing is borne any more.
    pub capacity_share: f64,
    /// The displacement whose secant gives the period, as a share of the one allowed.
    pub secant_share: f64,
    /// `c` of the secant period `c pi sqrt(d / a(d))`; 2 is the period of that secant itself.
    pub period_factor: f64,
    /// Equivalent viscous damping (%).
    pub damping_percent: f64,
}

/// A code, with what it fixes.
#[derive(Clone, Debug, PartialEq)]
pub struct Code {
    /// Its name and the clauses.
    pub name: String,
    /// The state in which life is safe.
    pub life: LimitState,
    /// The state before collapse, where the code has one.
    pub collapse: Option<LimitState>,
    /// Behaviour factor `q` of the check by acceleration.
    pub behaviour_factor: f64,
}

/// Confidence factor of the lowest level of knowledge, which stands for a multiplier that takes stones to bear any pressure (Circolare
/// 7/2019, C8.7.1.2.1.3 and table C8.5.IV).
pub const LOWEST_KNOWLEDGE: f64 = 1.35;

impl Code {
    /// NTC 2018 with Circolare 7/2019, C8.7.1.2.1.6 to C8.7.1.2.1.8.
    pub fn ntc_2018() -> Code {
        let state = |name: &str, capacity_share, period_factor, damping_percent| LimitState {
            name: name.to_owned(),
            capacity_share,
            secant_share: 1.0,
            period_factor,
            damping_percent,
        };
        Code {
            name: "NTC 2018, Circolare 7/2019, C8.7.1.2.1".to_owned(),
            life: state("SLV", 0.4, 1.68, 8.0),
            collapse: Some(state("SLC", 0.6, 1.56, 10.0)),
            behaviour_factor: 2.0,
        }
    }

    /// Circolare 617/2009, C8A.4.2.3, which that of 2019 has replaced.
    pub fn circolare_2009() -> Code {
        Code {
            name: "Circolare 617/2009, C8A.4.2 (replaced in 2019)".to_owned(),
            life: LimitState {
                name: "SLV".to_owned(),
                capacity_share: 0.4,
                secant_share: 0.4,
                period_factor: 2.0,
                damping_percent: 5.0,
            },
            collapse: None,
            behaviour_factor: 2.0,
        }
    }
}
