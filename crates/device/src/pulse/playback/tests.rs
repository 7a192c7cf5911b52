//! Tests with a simulated sound server.

use std::net::Shutdown;
use std::os::unix::net::UnixStream;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use pulseaudio::protocol::{Command, MAX_VERSION, PulseError, read_descriptor, write_command_message};

use super::{Connection, Playback};
use crate::edge::Edge;
use crate::engine::Handle;
use crate::output::tests::OPTIONS;
use crate::output_options::{Made, make_engine};
use crate::pulse::stream::PulseStream;
use crate::status::LinkState;

/// An open stream, the server's end of its connection, and the handle.
fn opened() -> (Playback, UnixStream, Handle) {
    let (ours, theirs) = UnixStream::pair().unwrap();
    let Made { handle, engine, reporter } = make_engine(OPTIONS, 48_000).unwrap();
    let playback = Playback {
        connection: Connection::of(ours),
        edge: Edge::new(engine, Arc::clone(&reporter.shared), 48_000.0),
        reporter,
        id: "pulse:test".into(),
        channel: 0,
        n_channels: 1,
        rate_hz: 48_000,
        block_frames: 128,
        block: Vec::new(),
        requested_bytes: 4 * 256,
        latency: Duration::ZERO,
        latency_asked: None,
        has_started: false,
    };
    (playback, theirs, handle)
}

/// The loss message of a stream whose server sends these messages and closes the connection.
fn loss_after(words: &[(u32, Command)], is_closing: bool) -> Option<String> {
    let (playback, mut server, mut handle) = opened();
    for (seq, command) in words {
        write_command_message(&mut server, *seq, command, MAX_VERSION).unwrap();
    }
    server.shutdown(Shutdown::Write).unwrap();
    playback.run(&AtomicBool::new(is_closing));
    assert_eq!(handle.status().state == LinkState::Lost, !is_closing);
    handle.loss().map(ToString::to_string)
}

#[test]
fn what_the_server_says_is_told_and_closing_is_no_loss() {
    // Message 0 requests the latency, and message 1 starts playback.
    let refused = |seq| (seq, Command::Error(PulseError::BadState));
    for (words, reason) in [
        (vec![], "the sound server has closed the connection ("),
        (vec![refused(1)], "the sound server refuses to start it (server error: BadState)"),
        (vec![refused(0)], "; earlier error: server error: BadState)"),
        (vec![refused(0), (u32::MAX, Command::PlaybackStreamKilled(0))], ": its sink was removed;"),
    ] {
        let told = loss_after(&words, false).unwrap();
        assert!(told.contains(reason) && told.contains("`pulse:test` is lost"), "{told}");
        assert_eq!(loss_after(&words, true), None);
    }
}

#[test]
fn a_line_that_is_hung_up_on_purpose_ends_without_a_loss() {
    let (playback, mut server, mut handle) = opened();
    let socket = playback.connection.socket().unwrap();
    let stream = PulseStream::start(socket, "output", move |closing| playback.run(closing)).unwrap();
    // After the latency request, the samples and the start command, the stream runs.
    for _ in 0..3 {
        let descriptor = read_descriptor(&mut server).unwrap();
        std::io::copy(&mut std::io::Read::take(&mut server, descriptor.length.into()), &mut std::io::sink())
            .unwrap();
    }
    drop(stream);
    assert_eq!((handle.status().state, handle.loss()), (LinkState::Running, None));
}
