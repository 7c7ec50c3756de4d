//! Laws of physics and closed forms: every test holds its own answer.

mod dynamics;
mod elastic;
mod fixture;
mod holding;
mod limit_known;
mod objectivity;
mod pressure;
mod shapes;
mod tilting;
mod tumbling;
