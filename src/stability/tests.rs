use super::*;
use crate::collision::*;
#[test]
fn explore() {
    let grids: Vec<usize> = std::env::var("GRIDS").unwrap_or("0,1".into()).split(',').map(|x| x.parse().unwrap()).collect();
    let taus: Vec<f64> = std::env::var("TAUS").unwrap_or("0.501".into()).split(',').map(|x| x.parse().unwrap()).collect();
    let ops: Vec<usize> = std::env::var("OPS").unwrap_or("0,1".into()).split(',').map(|x| x.parse().unwrap()).collect();
    let all = [("bgk", CollisionChoice::Bgk), ("trt316", CollisionChoice::Trt(OddRate::fixed(0.1875))),
       ("trt14", CollisionChoice::Trt(OddRate::fixed(0.25))), ("trt", CollisionChoice::Trt(OddRate::default())),
       ("cm", CollisionChoice::default()), ("cm316", CollisionChoice::CentralMoment(OddRate::fixed(0.1875))), ("reg", CollisionChoice::Regularised)];
    for o in ops { let (name, op) = all[o];
      for &tau in &taus { for d in Direction::ALL {
        let mut line = format!("{name} {tau} {}", d.name());
        for &grid in &grids {
          let t = std::time::Instant::now();
          let s = max_stable_speed_along(&op, tau, d, if grid==0 {&Search::QUICK} else if grid==1 {&Search::THOROUGH} else {&Search::EXHAUSTIVE}).unwrap();
          line += &format!("  N{grid}: {s:.5} ({:.1}s)", t.elapsed().as_secs_f64());
        }
        println!("{line}");
      }}
    }
}
