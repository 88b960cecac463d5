//! The examples run, and what they compute is what they say.

#[path = "../examples/channel.rs"]
mod channel;
#[path = "../examples/own_rheology.rs"]
mod own_rheology;
#[path = "../examples/scene.rs"]
mod scene;

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn exact_speed_of_a_plug_in_ten_lines() -> Outcome {
    channel::main()
}

#[test]
fn exact_speed_of_a_sheet_from_a_scene_in_rust() -> Outcome {
    scene::main()
}

#[test]
fn exact_speed_of_a_fluid_of_ones_own() -> Outcome {
    own_rheology::main()
}
