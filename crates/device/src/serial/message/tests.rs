use super::{
    Configure, Control, DeviceMessage, DeviceStatus, HelloReply, HostMessage, MAX_SAMPLES, Malformed, Mode,
    RunState, SampleBytes, from_device, from_host, write_samples, write_sensor, write_to_device,
    write_to_host,
};
use crate::serial::frame::{Decoder, Frame, MAX_PAYLOAD, MAX_WIRE};
use proptest::prelude::{any, prop, proptest};

/// Configuration for tests that do not depend on it.
pub(in crate::serial) const CONFIGURE: Configure = Configure {
    config: 1,
    mode: Mode::Stream,
    rate_hz: 4000,
    ceiling: 29_490,
    watchdog_ms: 50,
    window: 40,
    prefill: 24,
    report: 8,
    fade: 12,
    full_scale_cmps2: 2000,
};

const FRICTION: Configure = Configure {
    mode: Mode::Friction,
    rate_hz: 10_000,
    ceiling: 32_767,
    window: 100,
    prefill: 60,
    report: 20,
    fade: 30,
    full_scale_cmps2: 0,
    ..CONFIGURE
};

const STATUS: DeviceStatus = DeviceStatus {
    seq: 0x0210,
    config: 1,
    run: 3,
    state: RunState::Playing,
    free: 16,
    queued: 24,
    clock: 0x0001_0200,
    underruns: 2,
    bad_frames: 5,
    dropped: 7,
    ping: 9,
};

const REPLY: HelloReply<'_> = HelloReply {
    nonce: 0x1234,
    version: 1,
    has_stream: true,
    has_control: false,
    has_sensor: true,
    has_friction: false,
    rate_min_hz: 1000,
    rate_max_hz: 8000,
    buffer: 256,
    frame_max: 120,
    name: b"Voice coil",
};

/// Bytes on the line in hexadecimal, in the format of the protocol description.
fn hex(write: impl FnOnce(&mut [u8; MAX_WIRE]) -> usize) -> String {
    let mut wire = [0; MAX_WIRE];
    let len = write(&mut wire);
    wire[..len].iter().map(|byte| format!("{byte:02x}")).collect::<Vec<_>>().join(" ")
}

/// Example messages of the protocol description, in its order.
fn examples() -> Vec<String> {
    let control = Control { speed_dmmps: 1000, force_mn: 750, texture: 2, gain_permille: 1000 };
    let host = |message| hex(|wire| write_to_device(message, wire));
    let device = |message| hex(|wire| write_to_host(message, wire));
    vec![
        host(HostMessage::Hello { nonce: 0x1234, version: 1 }),
        host(HostMessage::Configure(CONFIGURE)),
        host(HostMessage::Configure(FRICTION)),
        hex(|wire| write_samples(0x0200, 3, &[0, 1, -1, 256], wire)),
        host(HostMessage::Control { seq: 5, run: 3, control }),
        host(HostMessage::Stop),
        host(HostMessage::Ping { id: 9 }),
        device(DeviceMessage::HelloReply(REPLY)),
        device(DeviceMessage::Status(STATUS)),
        hex(|wire| write_sensor((16, 3200, 1_000_000, 38_307), &[10, -10], wire)),
        device(DeviceMessage::Fault { has_stopped: true, text: b"driver too hot" }),
    ]
}

/// The protocol description lists the same bytes as the code produces.
#[test]
fn examples_are_those_of_the_description() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/serial-protocol.md");
    let description = std::fs::read_to_string(path).unwrap();
    for example in examples() {
        assert!(description.contains(&format!("`{example}`")), "{example} is not in {path}");
    }
}

fn host_round_trip(message: HostMessage<'_>) {
    let mut wire = [0; MAX_WIRE];
    let len = write_to_device(message, &mut wire);
    let mut decoder = Decoder::new();
    let n_frames = wire[..len].iter().filter(|&&byte| {
        decoder.push(byte).is_some_and(|frame| {
            assert_eq!(from_host(frame), Ok(Some(message)));
            true
        })
    });
    assert_eq!(n_frames.count(), 1);
}

fn device_round_trip(message: DeviceMessage<'_>) {
    let mut wire = [0; MAX_WIRE];
    let len = write_to_host(message, &mut wire);
    let mut decoder = Decoder::new();
    let n_frames = wire[..len].iter().filter(|&&byte| {
        decoder.push(byte).is_some_and(|frame| {
            assert_eq!(from_device(frame), Ok(Some(message)));
            true
        })
    });
    assert_eq!(n_frames.count(), 1);
}

#[test]
fn what_is_written_is_read() {
    let samples = SampleBytes(&[1, 0, 255, 127]);
    assert_eq!(samples.iter().collect::<Vec<_>>(), [1, 32_767]);
    let control = Control { speed_dmmps: 1, force_mn: 2, texture: 3, gain_permille: 4 };
    for message in [
        HostMessage::Hello { nonce: 7, version: 200 },
        HostMessage::Configure(CONFIGURE),
        HostMessage::Configure(Configure { mode: Mode::Control, ..CONFIGURE }),
        HostMessage::Configure(FRICTION),
        HostMessage::Samples { seq: 65_535, run: 255, samples },
        HostMessage::Control { seq: 0, run: 0, control },
        HostMessage::Stop,
        HostMessage::Ping { id: 1 },
    ] {
        host_round_trip(message);
    }
    let states = [RunState::Unconfigured, RunState::Armed, RunState::Filling, RunState::Playing];
    for state in states {
        device_round_trip(DeviceMessage::Status(DeviceStatus { state, ..STATUS }));
    }
    device_round_trip(DeviceMessage::HelloReply(REPLY));
    device_round_trip(DeviceMessage::HelloReply(HelloReply { has_control: true, name: b"", ..REPLY }));
    device_round_trip(DeviceMessage::HelloReply(HelloReply { has_friction: true, ..REPLY }));
    let sensor =
        DeviceMessage::Sensor { seq: 1, rate_hz: 2, time_us: 1 << 31, scale_umps2: 1 << 20, samples };
    device_round_trip(sensor);
    device_round_trip(DeviceMessage::Fault { has_stopped: false, text: b"hot" });
}

#[test]
fn later_versions_may_send_more() {
    let frame = |kind, payload| Frame { kind, seq: 0, payload };
    for kind in [0x00, 0x07, 0x7F, 0x80, 0x85, 0xFF] {
        assert_eq!(from_host(frame(kind, &[1, 2, 3])), Ok(None));
        assert_eq!(from_device(frame(kind, &[1, 2, 3])), Ok(None));
    }
    assert_eq!(from_host(frame(0x01, &[1, 99])), Ok(Some(HostMessage::Hello { nonce: 0, version: 1 })));
}

#[test]
fn what_is_short_or_means_nothing_is_malformed() {
    let host = |kind, payload: &[u8]| from_host(Frame { kind, seq: 0, payload }).map(|_| ());
    let device = |kind, payload: &[u8]| from_device(Frame { kind, seq: 0, payload }).map(|_| ());
    let long = [1; MAX_PAYLOAD];
    for (kind, least) in [(0x01, 1), (0x02, 18), (0x03, 3), (0x04, 9)] {
        assert_eq!(host(kind, &long[..least]), Ok(()));
        assert_eq!(host(kind, &long[..least - 1]), Err(Malformed), "{kind}");
    }
    for (kind, least) in [(0x81, 11), (0x82, 19), (0x83, 12), (0x84, 1)] {
        assert_eq!(device(kind, &long[..least]), Ok(()), "{kind}");
        assert_eq!(device(kind, &long[..least - 1]), Err(Malformed), "{kind}");
    }
    assert_eq!(host(0x03, &long[..4]), Err(Malformed), "half a sample must be rejected");
    assert_eq!(host(0x03, &long[..=(2 * MAX_SAMPLES)]), Ok(()));
    assert_eq!(host(0x03, &long[..3 + 2 * MAX_SAMPLES]), Err(Malformed), "too many samples must be rejected");
    assert_eq!(host(0x02, &[0; 18]), Err(Malformed), "configuration 0 must be rejected");
    assert_eq!(host(0x02, &[2; 18]), Ok(()));
    assert_eq!(host(0x02, &[3; 18]), Err(Malformed), "an unknown mode must be rejected");
}

proptest! {
    #[test]
    fn arbitrary_payloads_never_panic(
        kind in any::<u8>(), seq in any::<u16>(), payload in prop::collection::vec(any::<u8>(), 0..=MAX_PAYLOAD),
    ) {
        for kind in [kind, kind % 8, 0x80 + kind % 8] {
            let frame = Frame { kind, seq, payload: &payload };
            if let Ok(Some(message)) = from_host(frame) {
                host_round_trip(message);
            }
            if let Ok(Some(message)) = from_device(frame)
                && !matches!(message, DeviceMessage::HelloReply(reply) if reply.name.len() > super::MAX_NAME)
            {
                device_round_trip(message);
            }
        }
    }
}
