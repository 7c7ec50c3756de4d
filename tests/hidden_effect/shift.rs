//! How strong a hidden effect is in the eyes of a design, whatever the verdict: how far it moves what is seen.

use pirca::critic::Truth;
use pirca::random::standard_normal::quantile;
use pirca::study::Parameter;

use crate::inference::Judge;
use crate::truth::label::Label;

/// Campaigns that a shift is the mean of.
const CAMPAIGNS: u64 = 300;
const SEED: u64 = 19;
/// Quantiles nearer to 0 and 1 than this are as good as there.
const END: f64 = 1e-6;

/// How far campaigns with the mechanism and the joints of a label are from any without it, in standard deviations.
pub fn shift(judge: &Judge<'_>, label: &Label) -> f64 {
    let hidden = &label.hidden[0];
    let index = judge.index(&hidden.name);
    let mechanism = &judge.known.mechanisms[index];
    let score = |p: &Parameter| quantile(p.search.cdf(hidden.value(p.key)).clamp(END, 1.0 - END));
    let truth = Truth {
        causes: Some(index).into(),
        parameters: mechanism.parameters.iter().map(score).collect(),
        joints: label.joints.to_vec(),
        // In the middle of what specimens may differ by.
        scatter: 0.0,
    };
    let judge = judge.judge;
    judge.reference.shift(judge.world, &judge.design, &truth, CAMPAIGNS, SEED)
}
