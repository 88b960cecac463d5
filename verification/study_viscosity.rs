//! Study `viscosity`: decay of shear waves and vortices, sound.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::viscosity::STUDY, &lahar::solver::choose::Best)
}
