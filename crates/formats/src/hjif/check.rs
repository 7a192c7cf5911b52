//! Rules of a whole file, its avatars and its perceptions.

use std::collections::{BTreeMap, BTreeSet};

use crate::hjif::check_channel::{check_channel, check_effect};
use crate::hjif::date::{is_date, number_of};
use crate::hjif::faults::{Context, Faults, MOST_SHOWN};
use crate::hjif::rule::{FIRST_YEAR, MOST_CHANNELS, MOST_TICKS, Rule, SIMPLE_TICKS};
use crate::hjif::tree::{Avatar, AvatarType, Hjif, Modality, Perception, Profile, ReferenceDevice};
use crate::text_limits::begin_of;

/// Modalities of level 1 of the simple parametric profile.
const SIMPLE_MODALITIES: [Modality; 4] =
    [Modality::Force, Modality::Vibrotactile, Modality::Stiffness, Modality::VibrotactileTexture];

/// Returns the rules that a file breaks, in the order of the file.
pub(super) fn check(file: &Hjif) -> Faults {
    let mut faults = Faults::default();
    if !is_version(&file.version) {
        faults.add("version", Rule::Version { found: begin_of(file.version.clone(), MOST_SHOWN) });
    }
    if !(1..=2).contains(&file.level) {
        faults.add("level", Rule::Level { found: file.level });
    }
    if !is_date(&file.date) {
        faults.add("date", Rule::Date { found: begin_of(file.date.clone(), MOST_SHOWN) });
    }
    let profile = file.profile;
    let is_allowed = |ticks: u32| match profile {
        Profile::Main => (1..=MOST_TICKS).contains(&ticks),
        Profile::SimpleParametric => ticks == SIMPLE_TICKS,
    };
    let of_syncs = file.syncs.iter().enumerate();
    let timescales = std::iter::once(("timescale".to_owned(), file.timescale))
        .chain(of_syncs.map(|(index, sync)| (format!("syncs[{index}].timescale"), sync.timescale)));
    for (place, ticks) in timescales {
        if let Some(found) = ticks.filter(|ticks| !is_allowed(*ticks)) {
            faults.add(place, Rule::Timescale { found, profile });
        }
    }
    faults.check_unique("avatars", "avatar", file.avatars.iter().map(|avatar| avatar.id));
    for (index, avatar) in file.avatars.iter().enumerate() {
        check_avatar(avatar, &format!("avatars[{index}]"), &mut faults);
    }
    faults.check_unique("perceptions", "perception", file.perceptions.iter().map(|perception| perception.id));
    let avatars: BTreeSet<i32> = file.avatars.iter().map(|avatar| avatar.id).collect();
    for (index, perception) in file.perceptions.iter().enumerate() {
        let place = format!("perceptions[{index}]");
        let id = perception.avatar_id;
        if id != 0 && !avatars.contains(&id) {
            faults.add(format!("{place}.avatar_id"), Rule::NoSuch { what: "avatar", id });
        }
        check_perception(perception, file, &place, &mut faults);
    }
    faults
}

fn check_avatar(avatar: &Avatar, place: &str, faults: &mut Faults) {
    if avatar.id == 0 {
        faults.add(format!("{place}.id"), Rule::AvatarZero);
    }
    let is_custom = avatar.kind == AvatarType::Custom;
    let has_mesh = avatar.mesh.as_ref().is_some_and(|mesh| !mesh.trim().is_empty());
    if is_custom != has_mesh {
        faults.add(format!("{place}.mesh"), Rule::Mesh);
    }
}

fn check_perception(perception: &Perception, file: &Hjif, place: &str, faults: &mut Faults) {
    let Perception { reference_devices, effect_library, channels, .. } = perception;
    let (profile, level) = (file.profile, file.level);
    let is_simple = profile == Profile::SimpleParametric && level == 1;
    if is_simple && !SIMPLE_MODALITIES.contains(&perception.perception_modality) {
        faults.add(format!("{place}.perception_modality"), Rule::ModalityOfProfile);
    }
    let of_devices = format!("{place}.reference_devices");
    faults.check_unique(&of_devices, "reference device", reference_devices.iter().map(|device| device.id));
    for (index, device) in reference_devices.iter().enumerate() {
        check_device(device, &format!("{of_devices}[{index}]"), faults);
    }
    let context = Context {
        profile,
        level,
        devices: reference_devices.iter().map(|device| device.id).collect(),
        effects: effect_library.iter().filter_map(|effect| effect.id).collect(),
        scheme: perception.effect_semantic_scheme.as_deref(),
    };
    let of_library = format!("{place}.effect_library");
    let mut first: BTreeMap<i32, usize> = BTreeMap::new();
    for (index, effect) in effect_library.iter().enumerate() {
        let place = format!("{of_library}[{index}]");
        match effect.id {
            None => faults.add(&*place, Rule::Missing { what: "an effect of a library", field: "id" }),
            Some(id) => {
                if *first.entry(id).or_insert(index) != index {
                    faults.add(format!("{place}.id"), Rule::Twice { what: "effect of the library", id });
                }
            }
        }
        check_effect(effect, None, &context, &place, faults);
    }
    let of_channels = format!("{place}.channels");
    faults.check_number(&of_channels, ("channels", channels.len()), MOST_CHANNELS, level);
    faults.check_unique(&of_channels, "channel", channels.iter().map(|channel| channel.id));
    for (index, channel) in channels.iter().enumerate() {
        check_channel(channel, &context, &format!("{of_channels}[{index}]"), faults);
    }
}

fn check_device(device: &ReferenceDevice, place: &str, faults: &mut Faults) {
    let [low, resonance, high] = [
        ("the lowest frequency", device.minimum_frequency),
        ("the resonance frequency", device.resonance_frequency),
        ("the highest frequency", device.maximum_frequency),
    ]
    .map(|(name, frequency_hz)| frequency_hz.map(|frequency_hz| (name, frequency_hz)));
    for (below, above) in [(low, resonance), (resonance, high), (low, high)] {
        if let (Some(below), Some(above)) = (below, above) {
            faults.check_order(place, below, above);
        }
    }
    for (what, value) in [low, resonance, high].into_iter().flatten() {
        if value < 0.0 {
            faults.add(place, Rule::Negative { what, value });
        }
    }
}

/// Whether a text is a year, or a year and the number of an amendment.
fn is_version(text: &str) -> bool {
    let (year, amendment) = text.split_once('-').map_or((text, None), |(year, rest)| (year, Some(rest)));
    let is_year = number_of(year, 4).is_some_and(|year| year >= FIRST_YEAR);
    is_year && amendment.is_none_or(|amendment| number_of(amendment, 1).is_some_and(|n| n > 0))
}
