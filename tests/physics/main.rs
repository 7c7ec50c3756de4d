//! Laws of physics and closed forms: every test holds its own answer.

mod dynamics;
mod elastic;
mod fixture;
mod holding;
mod objectivity;
mod pressure;
mod shapes;
mod table;
mod tilting;
mod tumbling;
