//! A worker that prepares textures for the renderer, so that a drag to textures that have not played yet does not
//! block.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use shagreen_core::texture::plane::{Plane, Prepared};

/// Prepared texture: its index, and its plane, which shows whether the index still refers to it.
type Ahead = (usize, Arc<Plane>, Prepared);

/// Prepared textures, in the order of the planes.
pub(super) struct PlanesWorker {
    prepared: Vec<Option<Prepared>>,
    /// Textures not yet passed to a worker.
    waiting: Vec<(usize, Arc<Plane>)>,
    incoming: Receiver<Ahead>,
    sender: Sender<Ahead>,
}

impl PlanesWorker {
    pub(super) fn new(planes: &[Arc<Plane>]) -> Self {
        let (sender, incoming) = channel();
        let waiting = planes.iter().cloned().enumerate().collect();
        Self { prepared: vec![None; planes.len()], waiting, incoming, sender }
    }

    /// Changes the set of planes; those marked in `is_kept` are unchanged at their index.
    pub(super) fn follow(&mut self, planes: &[Arc<Plane>], is_kept: &[bool]) {
        let before = std::mem::take(&mut self.prepared);
        self.prepared = before.into_iter().zip(is_kept).map(|(p, is_kept)| p.filter(|_| *is_kept)).collect();
        self.prepared.resize(planes.len(), None);
        self.waiting.retain(|(i, plane)| planes.get(*i).is_some_and(|now| Arc::ptr_eq(now, plane)));
        let fresh = planes.iter().cloned().enumerate().filter(|(i, _)| !is_kept[*i]);
        self.waiting.extend(fresh);
    }

    /// Passes waiting textures to a new worker, once a frame. The worker ends after its last texture or with the
    /// session.
    pub(super) fn begin(&mut self, ctx: &egui::Context) {
        let planes = std::mem::take(&mut self.waiting);
        if planes.is_empty() {
            return;
        }
        let (sender, ctx) = (self.sender.clone(), ctx.clone());
        std::thread::spawn(move || {
            for (texture, plane) in planes {
                let prepared = plane.prepare();
                if sender.send((texture, plane, prepared)).is_err() {
                    return;
                }
                ctx.request_repaint();
            }
        });
    }

    /// Takes in prepared textures that are still valid, once a frame.
    pub(super) fn collect(&mut self, planes: &[Arc<Plane>]) {
        while let Ok((texture, plane, prepared)) = self.incoming.try_recv() {
            // Undo may have removed the texture in the meantime.
            if planes.get(texture).is_some_and(|now| Arc::ptr_eq(now, &plane)) {
                self.prepared[texture] = Some(prepared);
            }
        }
    }

    /// Prepared textures in the order of the planes, `None` where preparation is not complete.
    pub(super) fn prepared(&self) -> &[Option<Prepared>] {
        &self.prepared
    }
}
