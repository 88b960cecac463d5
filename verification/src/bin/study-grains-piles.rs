//! Study `grains-piles`: heaps of grains at rest, angles of repose, run-outs, speed.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(&lahar_verification::claims::piles::STUDY, &lahar::solver::choose::Best)
}
