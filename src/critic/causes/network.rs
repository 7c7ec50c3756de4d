//! A small network that gives the probability of each class from numbers: two hidden layers of rectified units, trained on examples
//! by Adam (Kingma and Ba 2015) on the cross entropy, its confidence corrected by one temperature (Guo et al. 2017).

use crate::interrupt;
use crate::math::{exp, ln};
use crate::random::Stream;
use crate::random::standard_normal::quantile;

/// Units of each hidden layer.
const HIDDEN: usize = 48;
const BATCH: usize = 50;
const EPOCHS: u32 = 25;
/// Step of Adam at the start; it goes down to nothing as a half cosine's chord, a straight line.
const RATE: f64 = 3e-3;

/// A layer: weights by unit and input, and a bias for each unit.
#[derive(Clone, Debug, PartialEq)]
struct Layer {
    inputs: usize,
    weights: Vec<f64>,
    bias: Vec<f64>,
}

/// A trained network.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    layers: [Layer; 3],
    /// What the last layer's sums are divided by.
    temperature: f64,
}

/// An example: inputs, and the number of the class.
pub type Example = (Vec<f64>, usize);

impl Network {
    /// Trains on examples of so many classes, all of the same number of inputs of order one; `held` ones, of all classes, tell the
    /// temperature.
    pub fn trained(examples: &[Example], held: &[Example], classes: usize, stream: &mut Stream) -> Network {
        crate::check!(
            !examples.is_empty() && !held.is_empty() && classes > 1,
            "{} examples and {} held of {classes} classes",
            examples.len(),
            held.len()
        );
        let inputs = examples[0].0.len();
        let layers = [
            Layer::new(inputs, HIDDEN, stream),
            Layer::new(HIDDEN, HIDDEN, stream),
            Layer::new(HIDDEN, classes, stream),
        ];
        let mut network = Network { layers, temperature: 1.0 };
        let mut order: Vec<usize> = (0..examples.len()).collect();
        let mut adam = Adam::new(&network);
        let batches = order.len().div_ceil(BATCH) * EPOCHS as usize;
        let mut done = 0;
        for _ in 0..EPOCHS {
            interrupt::look();
            for k in (1..order.len()).rev() {
                order.swap(k, stream.below(k + 1));
            }
            for batch in order.chunks(BATCH) {
                let mut slopes = Slopes::new(&network);
                for &k in batch {
                    network.add_slopes(&examples[k], &mut slopes);
                }
                let rate = RATE * (1.0 - done as f64 / batches as f64);
                adam.step(&mut network, &slopes, rate, batch.len() as f64);
                done += 1;
            }
        }
        network.temperature = network.best_temperature(held);
        network
    }

    /// The probability of each class.
    pub fn probabilities(&self, inputs: &[f64]) -> Vec<f64> {
        softmax(&self.sums(inputs)[2], self.temperature)
    }

    /// What each layer puts out, the hidden ones rectified.
    fn sums(&self, inputs: &[f64]) -> [Vec<f64>; 3] {
        let first = rectified(self.layers[0].apply(inputs));
        let second = rectified(self.layers[1].apply(&first));
        let last = self.layers[2].apply(&second);
        [first, second, last]
    }

    /// Adds the slopes of minus the logarithm of the probability of an example's class.
    fn add_slopes(&self, (inputs, class): &Example, slopes: &mut Slopes) {
        let [first, second, last] = self.sums(inputs);
        let mut back = softmax(&last, 1.0);
        back[*class] -= 1.0;
        let before = [inputs, &first, &second];
        for layer in (0..3).rev() {
            slopes.0[layer].add(&back, before[layer]);
            if layer > 0 {
                back = self.layers[layer].back(&back);
                for (slope, value) in back.iter_mut().zip(before[layer]) {
                    if *value <= 0.0 {
                        *slope = 0.0;
                    }
                }
            }
        }
    }

    /// The temperature that makes held examples most likely, to a per cent, between a fifth and five.
    fn best_temperature(&self, held: &[Example]) -> f64 {
        let sums: Vec<(Vec<f64>, usize)> =
            held.iter().map(|(inputs, class)| (self.sums(inputs)[2].clone(), *class)).collect();
        let loss = |temperature: f64| -> f64 {
            sums.iter()
                .fold(0.0, |sum, (sums, class)| sum - ln(softmax(sums, temperature)[*class].max(1e-300)))
        };
        let candidates = (0..=322).map(|k| 0.2 * exp(0.01 * f64::from(k)));
        let best = candidates
            .map(|t| (loss(t), t))
            .fold((f64::INFINITY, 1.0), |best, next| if next.0 < best.0 { next } else { best });
        best.1
    }
}

impl Layer {
    /// Random weights whose sums over rectified inputs keep their size (He et al. 2015), no bias.
    fn new(inputs: usize, units: usize, stream: &mut Stream) -> Layer {
        let sd = (2.0 / inputs as f64).sqrt();
        let weights = (0..inputs * units).map(|_| sd * quantile(stream.uniform())).collect();
        Layer { inputs, weights, bias: vec![0.0; units] }
    }

    fn zero(like: &Layer) -> Layer {
        Layer {
            inputs: like.inputs,
            weights: vec![0.0; like.weights.len()],
            bias: vec![0.0; like.bias.len()],
        }
    }

    fn apply(&self, inputs: &[f64]) -> Vec<f64> {
        let dot = |row: &[f64]| row.iter().zip(inputs).fold(0.0, |sum, (w, x)| sum + w * x);
        self.weights.chunks_exact(self.inputs).zip(&self.bias).map(|(row, bias)| bias + dot(row)).collect()
    }

    /// Slopes with respect to the inputs from those with respect to the sums.
    fn back(&self, slopes: &[f64]) -> Vec<f64> {
        let mut back = vec![0.0; self.inputs];
        for (row, slope) in self.weights.chunks_exact(self.inputs).zip(slopes) {
            back.iter_mut().zip(row).for_each(|(b, w)| *b += w * slope);
        }
        back
    }

    fn add(&mut self, slopes: &[f64], inputs: &[f64]) {
        for ((row, bias), slope) in self.weights.chunks_exact_mut(self.inputs).zip(&mut self.bias).zip(slopes)
        {
            row.iter_mut().zip(inputs).for_each(|(w, x)| *w += slope * x);
            *bias += slope;
        }
    }

    fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        self.weights.iter_mut().chain(&mut self.bias)
    }
}

/// Slopes of all numbers of a network.
struct Slopes([Layer; 3]);

impl Slopes {
    fn new(network: &Network) -> Slopes {
        Slopes(std::array::from_fn(|k| Layer::zero(&network.layers[k])))
    }
}

/// Running means of the slopes and of their squares.
struct Adam {
    mean: Slopes,
    square: Slopes,
    /// What the means still hold of their start at 0, as shares.
    start: [f64; 2],
}

impl Adam {
    fn new(network: &Network) -> Adam {
        Adam { mean: Slopes::new(network), square: Slopes::new(network), start: [1.0; 2] }
    }

    fn step(&mut self, network: &mut Network, slopes: &Slopes, rate: f64, examples: f64) {
        const MEAN: f64 = 0.9;
        const SQUARE: f64 = 0.999;
        self.start = [self.start[0] * MEAN, self.start[1] * SQUARE];
        let (mean_share, square_share) = (1.0 - self.start[0], 1.0 - self.start[1]);
        for k in 0..3 {
            let mut slopes = slopes.0[k].clone();
            let numbers = network.layers[k].numbers().zip(slopes.numbers());
            let running = self.mean.0[k].numbers().zip(self.square.0[k].numbers());
            for ((number, slope), (mean, square)) in numbers.zip(running) {
                let slope = *slope / examples;
                *mean = MEAN * *mean + (1.0 - MEAN) * slope;
                *square = SQUARE * *square + (1.0 - SQUARE) * slope * slope;
                *number -= rate * (*mean / mean_share) / ((*square / square_share).sqrt() + 1e-8);
            }
        }
    }
}

fn rectified(mut values: Vec<f64>) -> Vec<f64> {
    values.iter_mut().for_each(|x| *x = x.max(0.0));
    values
}

pub fn softmax(sums: &[f64], temperature: f64) -> Vec<f64> {
    let largest = sums.iter().fold(f64::NEG_INFINITY, |m, x| m.max(*x));
    let raised: Vec<f64> = sums.iter().map(|x| exp((x - largest) / temperature)).collect();
    let whole = raised.iter().fold(0.0, |sum, x| sum + x);
    raised.into_iter().map(|x| x / whole).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Streams;

    /// Two classes on a line, normal about -1 and 1 with standard deviation 1; the second input tells nothing.
    fn examples(count: u64) -> Vec<Example> {
        (0..count)
            .map(|k| {
                let mut stream = Streams::new(21, k).of("example");
                let class = stream.below(2);
                let centre = if class == 0 { -1.0 } else { 1.0 };
                let mut normal = || quantile(stream.uniform());
                (vec![centre + normal(), normal()], class)
            })
            .collect()
    }

    #[test]
    fn a_network_learns_the_probability_and_not_only_the_class() {
        let all = examples(4500);
        let network = Network::trained(&all[500..], &all[..500], 2, &mut Streams::new(1, 0).of("network"));
        for x in [-2.0, -1.0, -0.3, 0.0, 0.4, 1.2, 2.0] {
            for idle in [-1.0, 0.5] {
                let found = network.probabilities(&[x, idle]);
                // By Bayes: 1 / (1 + exp(-2 x)).
                let exact = 1.0 / (1.0 + exp(-2.0 * x));
                // Of 4,000 examples some hundred lie nearby: 0.05, and as much again for the shape of the curve.
                assert!((found[1] - exact).abs() < 0.1, "{x}, {idle}: {} against {exact}", found[1]);
                assert!((found[0] + found[1] - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_same_examples_and_stream_give_the_same_network() {
        let all = examples(200);
        let train = || Network::trained(&all[20..], &all[..20], 2, &mut Streams::new(1, 0).of("network"));
        assert_eq!(train(), train());
    }

    #[test]
    fn slopes_are_those_of_the_loss() {
        let mut stream = Streams::new(2, 0).of("network");
        let mut network = Network {
            layers: [
                Layer::new(3, 5, &mut stream),
                Layer::new(5, 4, &mut stream),
                Layer::new(4, 3, &mut stream),
            ],
            temperature: 1.0,
        };
        let example = (vec![0.3, -0.7, 1.1], 1);
        let mut slopes = Slopes::new(&network);
        network.add_slopes(&example, &mut slopes);
        let loss = |network: &Network| -ln(network.probabilities(&example.0)[1]);
        for layer in 0..3 {
            let expected: Vec<f64> = slopes.0[layer].numbers().map(|x| *x).collect();
            for (k, expected) in expected.into_iter().enumerate() {
                let h = 1e-6;
                let mut moved = |by: f64| {
                    *network.layers[layer].numbers().nth(k).expect("it is there") += by;
                    let loss = loss(&network);
                    *network.layers[layer].numbers().nth(k).expect("it is there") -= by;
                    loss
                };
                let found = (moved(h) - moved(-h)) / (2.0 * h);
                assert!((found - expected).abs() < 1e-6, "layer {layer}, {k}: {found} against {expected}");
            }
        }
    }
}
