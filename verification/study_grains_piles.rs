//! Study `grains-piles`: heaps of grains at rest, angles of repose, run-outs, speed.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::piles::STUDY, &lahar::solver::choose::Best)
}
