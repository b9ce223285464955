//! What the images take: flash, RAM, stack.

use hil_tests::{bench::Bench, dive::Dive, image, report};
use shared::wire::MAX_FRAME;
use sim_host::flight::{link::Machine, pilot::Pilot};

/// Flash and RAM that an image may take; the linker's map holds it to them too.
const FLASH: u64 = 128 * 1024;
const RAM: u64 = 32 * 1024;
/// Where the RAM of the F405 begins.
const F405_RAM: u64 = 0x2000_0000;
/// What `cortex-m-rt` paints the stack with.
const PAINT: u32 = 0xcccc_cccc;

#[test]
fn images_are_whole_and_within_their_budget() {
    for (machine, bin) in [(Machine::NetduinoPlus2, "f405"), (Machine::Mps2An386, "mps2")] {
        let sizes = image::sizes(&image::build(image::feature(machine), bin));
        report(&format!("{bin}: flash {} of {FLASH} bytes, statics {} of {RAM} bytes", sizes.flash, sizes.statics));
        // An image that was linked without its script is empty, or nearly so.
        assert!((30_000..=FLASH).contains(&sizes.flash), "{bin}: {sizes:?}");
        assert!(sizes.statics < RAM / 4, "{bin}: {sizes:?}");
    }
}

/// The linker drops what nobody calls: without a caller, the machinery of panics is not in the image at all.
///
/// This holds for the application and all that flies. The F405's image adds the start-up of its HAL, which can panic at
/// settings other than ours.
#[test]
fn no_panic_is_left_in_the_application() {
    let functions = image::functions(&image::build("mps2", "mps2"));
    assert!(functions.iter().any(|name| name.contains("autopilot")), "no symbols to look at: {functions:?}");
    let signs = ["panicking", "unwrap_failed", "expect_failed", "slice_index_fail"];
    let left: Vec<_> = functions.iter().filter(|name| signs.iter().any(|sign| name.contains(sign))).collect();
    assert!(left.is_empty(), "reachable panics: {left:#?}");
    let drill = image::functions(&image::build("mps2", "mps2-drill"));
    assert!(drill.iter().any(|name| name.contains("panicking")), "a panic would not be seen here");
}

/// Deepest stack of a dive: the lowest word that is no longer painted.
#[test]
fn the_stack_leaves_room() {
    let statics = image::sizes(&image::build("f405", "f405")).statics;
    let dive = Dive::short();
    let (mut firmware, traces) = Bench::start(Machine::NetduinoPlus2, "f405").pilot(&dive);
    dive.fly(&mut firmware as &mut dyn Pilot).unwrap();
    let said = firmware.emulator().unwrap().monitor(&format!("pmemsave {F405_RAM:#x} {RAM} ram")).unwrap();
    let ram = std::fs::read(traces.folder().join("ram")).unwrap_or_else(|error| panic!("{error}: {said}"));
    let (words, _) = ram.as_chunks::<4>();
    let first = usize::try_from(statics.div_ceil(4)).unwrap();
    let painted = words[first..].iter().take_while(|word| u32::from_le_bytes(**word) == PAINT).count() as u64 * 4;
    let stack = RAM - statics - painted;
    report(&format!("f405: stack {stack} bytes of {}; {painted} never touched", RAM - statics));
    assert!(stack > MAX_FRAME as u64, "a stack that holds no frame was not measured");
    assert!(painted >= RAM / 4, "{painted} bytes of stack were never touched");
}
