use super::*;

#[test]
fn explore() {
    for (name, layout) in [
        ("disc", discontinuous()),
        ("coursed", coursed()),
        ("coursed wedges", with_wedges(coursed())),
        ("coursed wythes", with_wedges(two_wythes(coursed()))),
        ("cut long", cut(DipAbout::LongAxis)),
        ("cut thick", cut(DipAbout::ThicknessAxis)),
        ("cut both", cut(DipAbout::Both)),
        ("cut all", with_wedges(two_wythes(cut(DipAbout::LongAxis)))),
    ] {
        let start = std::time::Instant::now();
        let (mut n, mut a, mut m, mut r, mut bad, mut w, mut ww) = (0, 0, 0, 0, 0, 0, 0);
        let mut why = String::new();
        for i in 0..300 {
            match generate(&layout, &Streams::new(7, i)) {
                Ok(g) => {
                    n += g.wall.blocks.len();
                    a += g.attempts;
                    m += g.merges;
                    r += g.redraws;
                    w += g.realised.wedges;
                    ww += g.realised.wedges_wanted;
                }
                Err(e) => {
                    bad += 1;
                    why = e.to_string();
                }
            }
        }
        let ms = start.elapsed().as_secs_f64() / 300.0 * 1e3;
        println!(
            "{name}: stones {} attempts {a} merges {m} redraws {r} bad {bad} wedges {w}/{ww} {ms:.3} ms {why}",
            n / 300
        );
    }
}
