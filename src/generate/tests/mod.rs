//! Properties of generated walls: validity, fit, draws against requests, and streams.

mod cells;
mod draws;
mod streams;
mod surveyed;
mod validity;

use crate::generate::{
    Arrangement, BatteredFace, DipAbout, Generated, Layout, Limits, Outline, Sizes, Wedges, Wythes, generate,
};
use crate::math::radians;
use crate::random::{Family, Streams};

/// The wall of the source paper's section 4.1, 4 m long, with stones of about 0.4 x 0.2 m.
fn layout(arrangement: Arrangement) -> Layout {
    Layout {
        outline: Outline {
            length: 4.0,
            height: 1.0,
            base_thickness: 0.45,
            top_thickness: 0.25,
            battered_face: BatteredFace::Front,
        },
        arrangement,
        density: Family::Normal { mean: 2400.0, sd: 50.0 },
        wythes: Wythes { count: 1, header_share: 0.0 },
        head_joint_gap: 0.001,
        wedges: None,
        limits: Limits {
            min_size: 0.03,
            max_aspect: 8.0,
            min_volume: 1e-6,
            max_redraws: 100,
            max_attempts: 20,
        },
    }
}

fn dip() -> Family {
    Family::Uniform { low: radians(-20.0), high: radians(20.0) }
}

fn length() -> Family {
    Family::TruncatedNormal { mean: 0.4, sd: 0.08, low: 0.2, high: 0.6 }
}

fn height() -> Family {
    Family::TruncatedNormal { mean: 0.2, sd: 0.03, low: 0.1, high: 0.3 }
}

fn coursed() -> Layout {
    layout(Arrangement::Coursed {
        sizes: Sizes::Apart { length: length(), height: height() },
        wall_size_factor: Family::Lognormal { mean: 1.0, sd: 0.2 },
        dip: dip(),
        least_overlap: 0.15,
    })
}

fn cut(dip_about: DipAbout) -> Layout {
    layout(Arrangement::Cut {
        sizes: Sizes::Apart { length: length(), height: height() },
        wall_size_factor: Family::Lognormal { mean: 1.0, sd: 0.2 },
        dip: dip(),
        dip_about,
    })
}

fn discontinuous() -> Layout {
    layout(Arrangement::Discontinuous { length: 0.4, height: 0.2, overlap: 0.5 })
}

fn with_wedges(mut layout: Layout) -> Layout {
    layout.wedges = Some(Wedges {
        share: 0.3,
        height: Family::Uniform { low: 0.02, high: 0.05 },
        depth: Family::Uniform { low: 0.05, high: 0.12 },
    });
    layout
}

fn two_wythes(mut layout: Layout) -> Layout {
    layout.wythes = Wythes { count: 2, header_share: 0.3 };
    layout
}

fn member(layout: &Layout, member: u64) -> Generated {
    generate(layout, &Streams::new(7, member)).unwrap_or_else(|e| panic!("member {member}: {e}"))
}
