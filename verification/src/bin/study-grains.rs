//! Study `grains`: collisions, rolling, rotation and sums of spheres and clumps, without fluid.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(&lahar_verification::claims::grains::STUDY, &lahar::solver::choose::Best)
}
