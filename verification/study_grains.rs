//! Study `grains`: collisions, rolling, rotation and sums of spheres and clumps, without fluid.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::grains::STUDY, &lahar::solver::choose::Best)
}
