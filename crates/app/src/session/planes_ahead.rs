//! What the output takes of each texture is worked out by a worker: a drag into textures not yet heard must not wait for it.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use shagreen_core::plane::{Plane, Prepared};

/// A texture that was prepared: where it was in the list, and the plane that tells whether it still is.
type Ahead = (usize, Arc<Plane>, Prepared);

/// The textures as far as they are prepared, in the order of the planes.
pub(super) struct PlanesAhead {
    prepared: Vec<Option<Prepared>>,
    /// Textures that no worker prepares yet.
    waiting: Vec<(usize, Arc<Plane>)>,
    incoming: Receiver<Ahead>,
    sender: Sender<Ahead>,
}

impl PlanesAhead {
    /// None of these is prepared yet.
    pub(super) fn new(planes: &[Arc<Plane>]) -> Self {
        let (sender, incoming) = channel();
        let waiting = planes.iter().cloned().enumerate().collect();
        Self { prepared: vec![None; planes.len()], waiting, incoming, sender }
    }

    /// From now on these are wanted; those that `is_kept` were the same at their place before.
    pub(super) fn follow(&mut self, planes: &[Arc<Plane>], is_kept: &[bool]) {
        let before = std::mem::take(&mut self.prepared);
        self.prepared = before.into_iter().zip(is_kept).map(|(p, is_kept)| p.filter(|_| *is_kept)).collect();
        self.prepared.resize(planes.len(), None);
        self.waiting.retain(|(i, plane)| planes.get(*i).is_some_and(|now| Arc::ptr_eq(now, plane)));
        let fresh = planes.iter().cloned().enumerate().filter(|(i, _)| !is_kept[*i]);
        self.waiting.extend(fresh);
    }

    /// Once a frame: sets a worker to what waits for one. It ends with its textures or with the session.
    pub(super) fn begin(&mut self) {
        let planes = std::mem::take(&mut self.waiting);
        if planes.is_empty() {
            return;
        }
        let sender = self.sender.clone();
        std::thread::spawn(move || {
            for (texture, plane) in planes {
                let prepared = plane.prepare();
                if sender.send((texture, plane, prepared)).is_err() {
                    return;
                }
            }
        });
    }

    /// Once a frame: takes in what is done, as far as it is one of these.
    pub(super) fn collect(&mut self, planes: &[Arc<Plane>]) {
        while let Ok((texture, plane, prepared)) = self.incoming.try_recv() {
            // Undo may have taken it away meanwhile.
            if planes.get(texture).is_some_and(|now| Arc::ptr_eq(now, &plane)) {
                self.prepared[texture] = Some(prepared);
            }
        }
    }

    /// The textures in the order of the planes, `None` while one is not prepared.
    pub(super) fn prepared(&self) -> &[Option<Prepared>] {
        &self.prepared
    }
}
