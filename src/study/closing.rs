//! A study whose joints close along a table.

use crate::law::ClosureTable;
use crate::study::checked::{Arm, StatedLaw, Study};
use crate::study::fault::Faults;
use crate::study::stated::{Settings, Stated, family_value};

impl Arm {
    /// Whether no other law of closure stands in the way of a table.
    pub fn is_free_to_close(&self) -> bool {
        let other = ["joint_closure", "stress_stiffening"].iter().any(|law| self.mechanisms.has(law));
        !other && self.joint.normal_law == StatedLaw::Linear
    }

    /// The arm with joints that close along a table: closures (m) and stresses (Pa) of its knots. `None` where these are no table.
    pub fn closing_along(mut self, closures: &[f64], stresses: &[f64]) -> Option<Arm> {
        let table = ClosureTable::through(closures, stresses)?;
        self.joint.normal_law = StatedLaw::Table(Box::new(table));
        Some(self)
    }
}

impl Study {
    /// What its files state with the joints of some arms, by index, as they are here: stiffness, friction and law of closure. Limit
    /// analysis beside the solver is left out, as it refuses a table.
    ///
    /// # Errors
    /// The faults of values that their keys do not allow.
    pub fn closing(&self, stated: &Stated, arms: &[(usize, &Arm)]) -> Result<Stated, Faults> {
        let mut set = Settings::new();
        for (index, with) in arms {
            let name = &self.arms[*index].name;
            let mut joint =
                |key: &str, value: toml::Value| set.insert(format!("arm.{name}.joint.{key}"), value);
            joint("kn_pa_per_m", with.kn_points.clone().into());
            joint("phi_deg", family_value(&with.joint.phi_deg));
            joint("kn_over_ks", with.joint.kn_over_ks.into());
            if let StatedLaw::Table(table) = &with.joint.normal_law {
                let [closures, stresses] = table.knots();
                joint("normal_law", "table".into());
                joint("table_closure_m", closures.to_vec().into());
                joint("table_stress_pa", stresses.to_vec().into());
            }
        }
        if self.agreement {
            set.insert("solver.agreement".to_owned(), false.into());
        }
        stated.clone().with(set, Vec::new())
    }
}
