//! The options of what a wall holds back or bears, as clap reads them; their docstrings are the help.

use clap::Args;

use crate::verb::analyse::numbers;

/// The heading of these options.
const BEHIND: &str = "Fill, pressure and loads on the crest";

/// Of `--load fill`, `water`, `pressure` and `point`. All push towards `--direction`, from the other side.
#[derive(Clone, Args, Debug, Default)]
pub(crate) struct Behind {
    /// Density of the fill (kg/m^3), for --load fill. Of an --undrained one that of the soil with its pores full of water.
    #[arg(long, value_name = "KG_PER_M3", value_parser = numbers::fill_density, allow_negative_numbers = true, help_heading = BEHIND)]
    pub fill_density: Option<f64>,
    /// Friction angle of the fill (deg), for --load fill.
    #[arg(long, value_name = "DEG", value_parser = numbers::fill_friction, allow_negative_numbers = true, help_heading = BEHIND)]
    pub fill_phi_deg: Option<f64>,
    /// The share of its friction angle with which the fill rubs on the back of the wall, going down past it: 0 to 1 [default: 0, the safe
    /// side].
    #[arg(long, value_name = "SHARE", value_parser = numbers::wall_friction, allow_negative_numbers = true, help_heading = BEHIND)]
    pub wall_friction: Option<f64>,
    /// Slope of the surface of the fill (deg), above 0 where it rises away from the wall; at most --fill-phi-deg [default: 0].
    #[arg(long, value_name = "DEG", value_parser = numbers::fill_slope, allow_negative_numbers = true, help_heading = BEHIND)]
    pub fill_slope_deg: Option<f64>,
    /// Weight on the surface of the fill (Pa, per horizontal area) [default: 0].
    #[arg(long, value_name = "PA", value_parser = numbers::surcharge, allow_negative_numbers = true, help_heading = BEHIND)]
    pub surcharge_pa: Option<f64>,
    /// Water stands in the fill up to its surface: it presses by itself, and the soil weighs so much less [default: drained].
    #[arg(long, help_heading = BEHIND)]
    pub undrained: bool,
    /// Mean pressure (Pa) over the height of the wall, for --load pressure; the answer is a factor on it.
    #[arg(long, value_name = "PA", value_parser = numbers::pressure, allow_negative_numbers = true, help_heading = BEHIND)]
    pub pressure_pa: Option<f64>,
    /// Pressure at the base over that at the top, for --load pressure [default: 1].
    #[arg(long, value_name = "RATIO", value_parser = numbers::base_over_top, allow_negative_numbers = true, help_heading = BEHIND)]
    pub base_over_top: Option<f64>,
    /// Force (N) in the middle of the top of one stone of the crest, for --load point; the answer is a factor on it.
    #[arg(
        long,
        value_name = "N",
        value_parser = numbers::force,
        allow_negative_numbers = true,
        conflicts_with = "crest_line",
        help_heading = BEHIND
    )]
    pub crest_force: Option<f64>,
    /// Where along the crest --crest-force acts: so far from the left end, seen from behind (1.2m) [default: the middle].
    #[arg(long, value_name = "LENGTH", value_parser = numbers::size, allow_negative_numbers = true, requires = "crest_force", help_heading = BEHIND)]
    pub crest_at: Option<f64>,
    /// Force per length (N/m) along the whole crest, for --load point, instead of --crest-force.
    #[arg(long, value_name = "N_PER_M", value_parser = numbers::force, allow_negative_numbers = true, help_heading = BEHIND)]
    pub crest_line: Option<f64>,
    /// By how much that force points below the horizontal (deg): 0 pushes the crest over, 90 is a weight on it [default: 0].
    #[arg(long, value_name = "DEG", value_parser = numbers::below_horizontal, allow_negative_numbers = true, help_heading = BEHIND)]
    pub crest_down_deg: Option<f64>,
}

impl Behind {
    /// Its options by the load that they are for, with whether they are given.
    pub fn given(&self) -> [(&'static str, &'static str, bool); 12] {
        [
            ("fill", "--fill-density", self.fill_density.is_some()),
            ("fill", "--fill-phi-deg", self.fill_phi_deg.is_some()),
            ("fill", "--wall-friction", self.wall_friction.is_some()),
            ("fill", "--fill-slope-deg", self.fill_slope_deg.is_some()),
            ("fill", "--surcharge-pa", self.surcharge_pa.is_some()),
            ("fill", "--undrained", self.undrained),
            ("pressure", "--pressure-pa", self.pressure_pa.is_some()),
            ("pressure", "--base-over-top", self.base_over_top.is_some()),
            ("point", "--crest-force", self.crest_force.is_some()),
            ("point", "--crest-at", self.crest_at.is_some()),
            ("point", "--crest-line", self.crest_line.is_some()),
            ("point", "--crest-down-deg", self.crest_down_deg.is_some()),
        ]
    }
}
