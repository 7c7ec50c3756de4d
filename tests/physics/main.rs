//! Laws of physics and closed forms: every test holds its own answer.

mod agreement;
mod dynamics;
mod elastic;
mod fixture;
mod grains;
mod holding;
mod implicit;
mod limit_answers;
mod limit_column;
mod limit_flow;
mod limit_known;
mod limit_random;
mod limit_self_stress;
mod limit_solver;
mod mechanisms_alike;
mod mechanisms_joints;
mod mechanisms_loading;
mod objectivity;
mod pressure;
mod remainders;
mod ropes;
mod shapes;
mod table;
mod tilting;
mod tumbling;
