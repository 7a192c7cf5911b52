//! When which stimulus of a trial is presented: started by the participant, or by itself for set times.
//!
//! All times are in s since the first frame of the trial.

use shagreen_core::people::study::plan::Timing;

/// Silence before a stimulus that the participant starts, in s. Without it, a change between equal stimuli, which nothing
/// interrupts, would be told from one between different stimuli, which fade.
const SILENCE_SECS: f64 = 0.06;

/// How the stimuli of a trial are presented.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Presentation {
    /// Participants start the stimuli in any order.
    Free,
    /// The only stimulus starts by itself.
    Alone,
    /// The stimuli follow each other by themselves.
    Succession,
}

/// Presentation of the stimuli of one trial.
#[derive(Clone, Debug)]
pub(super) struct Presenter {
    presentation: Presentation,
    timing: Timing,
    max_plays: Option<u32>,
    n_plays: Vec<u32>,
    state: State,
    /// End of the last presentation that lasted its set time to its end.
    ended_secs: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Silent,
    /// A stimulus starts at this time.
    Waiting {
        from_secs: f64,
        next: usize,
    },
    Playing {
        stimulus: usize,
        since_secs: f64,
    },
}

impl Presenter {
    /// Presentation of so many stimuli, each started at most `max_plays` times.
    pub(super) fn new(
        presentation: Presentation,
        n_stimuli: usize,
        timing: Timing,
        max_plays: Option<u32>,
    ) -> Self {
        let begins_by_itself = presentation != Presentation::Free && n_stimuli > 0;
        let state = if begins_by_itself {
            State::Waiting { from_secs: timing.lead_secs, next: 0 }
        } else {
            State::Silent
        };
        Self { presentation, timing, max_plays, n_plays: vec![0; n_stimuli], state, ended_secs: None }
    }

    /// Starts and stops what is due at a time.
    pub(super) fn follow(&mut self, now_secs: f64) {
        if let State::Waiting { from_secs, next } = self.state
            && now_secs >= from_secs
        {
            self.start(next, now_secs);
        }
        if let (State::Playing { stimulus, since_secs }, Some(secs)) = (self.state, self.timing.stimulus_secs)
            && now_secs >= since_secs + self.silence_secs() + secs
        {
            let next = stimulus + 1;
            self.state = if self.presentation == Presentation::Succession && next < self.n_plays.len() {
                State::Waiting { from_secs: now_secs + self.timing.gap_secs, next }
            } else {
                self.ended_secs = Some(now_secs);
                State::Silent
            };
        }
    }

    /// Starts a stimulus, or stops it if it plays and has no set time.
    pub(super) fn toggle(&mut self, stimulus: usize, now_secs: f64) {
        match self.state {
            State::Playing { stimulus: playing, .. }
                if playing == stimulus && self.timing.stimulus_secs.is_none() =>
            {
                self.state = State::Silent;
            }
            // It ends by itself.
            State::Playing { stimulus: playing, .. } if playing == stimulus => {}
            _ if self.can_start(stimulus, now_secs) => self.start(stimulus, now_secs),
            _ => {}
        }
    }

    /// Presents all stimuli of a succession, or the only one, again.
    pub(super) fn repeat(&mut self, now_secs: f64) {
        if self.can_repeat() {
            self.state = State::Waiting { from_secs: now_secs, next: 0 };
        }
    }

    /// Whether [`Presenter::repeat`] does something.
    pub(super) fn can_repeat(&self) -> bool {
        self.presentation != Presentation::Free
            && self.state == State::Silent
            && (0..self.n_plays.len()).all(|stimulus| self.has_plays_left(stimulus))
            && !self.n_plays.is_empty()
    }

    /// Whether the participant can start a stimulus at a time.
    pub(super) fn can_start(&self, stimulus: usize, now_secs: f64) -> bool {
        self.presentation == Presentation::Free
            && now_secs >= self.timing.lead_secs
            && self.has_plays_left(stimulus)
    }

    /// Whether the participant can move the tip over a stimulus: it plays or can be started, and the tip does not move by itself.
    pub(super) fn can_be_felt(&self, stimulus: usize) -> bool {
        let is_due = matches!(self.state, State::Waiting { .. }) || self.playing() == Some(stimulus);
        !self.is_passive() && (is_due || self.has_plays_left(stimulus))
    }

    /// How often a stimulus can still be started; `None` for any number of times.
    pub(super) fn n_plays_left(&self, stimulus: usize) -> Option<u32> {
        let n_played = self.n_plays.get(stimulus).copied().unwrap_or(0);
        self.max_plays.map(|most| most.saturating_sub(n_played))
    }

    /// The stimulus that plays.
    pub(super) fn playing(&self) -> Option<usize> {
        match self.state {
            State::Playing { stimulus, .. } => Some(stimulus),
            State::Silent | State::Waiting { .. } => None,
        }
    }

    /// The stimulus that plays, after the silence before it.
    pub(super) fn audible(&self, now_secs: f64) -> Option<usize> {
        match self.state {
            State::Playing { stimulus, since_secs } if now_secs >= since_secs + self.silence_secs() => {
                Some(stimulus)
            }
            _ => None,
        }
    }

    /// Whether something starts or stops by itself after this time.
    pub(super) fn is_timed(&self, now_secs: f64) -> bool {
        match self.state {
            State::Silent => false,
            State::Waiting { .. } => true,
            State::Playing { .. } => self.timing.stimulus_secs.is_some() || self.audible(now_secs).is_none(),
        }
    }

    /// Whether the automatic stroke makes the stimuli felt: those of a succession with set times.
    pub(super) fn is_passive(&self) -> bool {
        self.presentation == Presentation::Succession
    }

    /// Stimuli that have not been started yet.
    pub(super) fn not_started(&self) -> Vec<usize> {
        (0..self.n_plays.len()).filter(|stimulus| self.n_plays[*stimulus] == 0).collect()
    }

    /// Whether everything was presented, so that the participant can answer.
    pub(super) fn has_presented_all(&self) -> bool {
        let has_end = self.presentation != Presentation::Free && self.timing.stimulus_secs.is_some();
        self.not_started().is_empty() && (!has_end || self.n_plays.is_empty() || self.ended_secs.is_some())
    }

    /// Time from which a response time counts: the end of a presentation of set times, else the first frame.
    pub(super) fn counts_from_secs(&self) -> f64 {
        if self.presentation == Presentation::Free { 0.0 } else { self.ended_secs.unwrap_or(0.0) }
    }

    /// How often each stimulus was started.
    pub(super) fn n_plays(&self) -> &[u32] {
        &self.n_plays
    }

    fn silence_secs(&self) -> f64 {
        if self.presentation == Presentation::Free { SILENCE_SECS } else { 0.0 }
    }

    fn has_plays_left(&self, stimulus: usize) -> bool {
        stimulus < self.n_plays.len() && self.n_plays_left(stimulus) != Some(0)
    }

    fn start(&mut self, stimulus: usize, now_secs: f64) {
        if let Some(n_plays) = self.n_plays.get_mut(stimulus) {
            *n_plays += 1;
            self.state = State::Playing { stimulus, since_secs: now_secs };
        }
    }
}

#[cfg(test)]
mod tests {
    use shagreen_core::people::study::plan::Timing;

    use super::{Presentation, Presenter};

    const TIMING: Timing =
        Timing { lead_secs: 0.5, stimulus_secs: Some(0.8), gap_secs: 0.6, pause_secs: 1.0 };

    #[test]
    fn a_succession_keeps_its_times() {
        let mut presenter = Presenter::new(Presentation::Succession, 2, TIMING, Some(2));
        for (now_secs, playing) in [
            (0.0, None),
            (0.49, None),
            (0.5, Some(0)),
            (1.29, Some(0)),
            (1.3, None),
            (1.89, None),
            (1.91, Some(1)),
            (2.7, Some(1)),
            (2.72, None),
            (9.0, None),
        ] {
            assert!(now_secs >= 2.72 || !presenter.has_presented_all());
            presenter.follow(now_secs);
            assert_eq!(presenter.playing(), playing, "{now_secs}");
        }
        assert!(presenter.has_presented_all() && presenter.can_repeat() && !presenter.is_timed(9.0));
        assert!((presenter.counts_from_secs() - 2.72).abs() < 1e-9);
        presenter.repeat(10.0);
        for now_secs in [10.0, 10.81, 11.42, 12.23] {
            presenter.follow(now_secs);
        }
        assert_eq!((presenter.n_plays(), presenter.can_repeat()), (&[2, 2][..], false));
        assert!((presenter.counts_from_secs() - 12.23).abs() < 1e-9);
    }

    #[test]
    fn stimuli_are_explored_freely_as_often_as_the_plan_allows() {
        let timing = Timing { lead_secs: 0.5, ..Timing::default() };
        let mut presenter = Presenter::new(Presentation::Free, 2, timing, Some(2));
        presenter.toggle(0, 0.1);
        assert_eq!(presenter.playing(), None, "the lead is not over");
        presenter.toggle(0, 0.6);
        assert_eq!((presenter.playing(), presenter.not_started()), (Some(0), vec![1]));
        presenter.toggle(1, 0.7);
        assert_eq!((presenter.playing(), presenter.has_presented_all()), (Some(1), true));
        assert_eq!((presenter.audible(0.71), presenter.audible(0.78)), (None, Some(1)));
        assert!(presenter.is_timed(0.71) && !presenter.is_timed(0.78));
        presenter.toggle(1, 0.8);
        assert_eq!(presenter.playing(), None);
        presenter.toggle(1, 0.9);
        presenter.toggle(0, 1.0);
        presenter.toggle(1, 1.1);
        assert_eq!(presenter.playing(), Some(0), "the other one has no plays left");
        assert_eq!((presenter.n_plays_left(0), presenter.n_plays_left(1)), (Some(0), Some(0)));
        assert_eq!(presenter.counts_from_secs(), 0.0);
    }

    #[test]
    fn what_cannot_be_started_again_cannot_be_felt() {
        let timing = Timing { stimulus_secs: Some(0.8), ..Timing::default() };
        let mut free = Presenter::new(Presentation::Free, 2, timing, Some(1));
        free.toggle(0, 0.0);
        assert!(free.can_be_felt(0) && free.can_be_felt(1), "the first one plays");
        free.follow(1.0);
        assert!(!free.can_be_felt(0) && free.can_be_felt(1));
        let mut alone = Presenter::new(Presentation::Alone, 1, TIMING, Some(1));
        assert!(alone.can_be_felt(0), "it is about to start");
        for now_secs in [0.5, 1.4] {
            alone.follow(now_secs);
        }
        assert!(!alone.can_be_felt(0));
        // In a succession, the tip moves by itself.
        let succession = Presenter::new(Presentation::Succession, 2, TIMING, None);
        assert!(!succession.can_be_felt(0));
        let nothing = Presenter::new(Presentation::Free, 0, Timing::default(), None);
        assert!(!nothing.can_be_felt(0));
    }

    #[test]
    fn a_single_stimulus_starts_by_itself_and_stops_after_its_time() {
        let mut timed = Presenter::new(Presentation::Alone, 1, TIMING, Some(1));
        for now_secs in [0.0, 0.5, 1.0] {
            timed.follow(now_secs);
        }
        assert_eq!((timed.playing(), timed.has_presented_all()), (Some(0), false));
        timed.follow(1.3);
        assert!(timed.playing().is_none() && timed.has_presented_all() && !timed.can_repeat());
        let mut free = Presenter::new(Presentation::Alone, 1, Timing::default(), None);
        free.follow(0.0);
        free.follow(1000.0);
        assert_eq!((free.playing(), free.has_presented_all()), (Some(0), true));
        let nothing = Presenter::new(Presentation::Free, 0, Timing::default(), None);
        assert!(nothing.has_presented_all() && !nothing.can_repeat());
    }
}
