//! Dates of ISO 8601.

/// Seconds of a day.
const DAY_SECS: u64 = 86_400;
/// Days of the months, with that of leap years.
const DAYS: [u32; 12] = [31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

/// Returns the day at a time in seconds since 1970 (Unix time, UTC), such as "2026-01-31".
pub fn iso_date(unix_secs: u64) -> String {
    let (mut year, mut days) = (1970, unix_secs / DAY_SECS);
    while days >= days_of_year(year) {
        days -= days_of_year(year);
        year += 1;
    }
    let mut month = 0;
    while days >= days_of_month(year, month) {
        days -= days_of_month(year, month);
        month += 1;
    }
    format!("{year:04}-{:02}-{:02}", month + 1, days + 1)
}

fn is_leap(year: u64) -> bool {
    year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
}

fn days_of_year(year: u64) -> u64 {
    if is_leap(year) { 366 } else { 365 }
}

/// Days of a month, counted from 0.
fn days_of_month(year: u64, month: usize) -> u64 {
    let is_short = month == 1 && !is_leap(year);
    u64::from(DAYS[month]) - u64::from(is_short)
}

/// Whether a text is a date of ISO 8601: year, year and month, or a day, with or without a time; hyphens and colons may be left
/// out of a day and its time. A space may stand for the `T` before the time, as in RFC 3339.
pub(super) fn is_date(text: &str) -> bool {
    let (day, time) = text.split_once(['T', ' ']).map_or((text, None), |(day, time)| (day, Some(time)));
    let with_hyphens = number_of(day, 8).map(|_| format!("{}-{}-{}", &day[..4], &day[4..6], &day[6..]));
    let mut parts = with_hyphens.as_deref().unwrap_or(day).split('-');
    let mut number = |digits: usize| parts.next().map(|part| number_of(part, digits));
    let (year, month, day_of_month) = (number(4), number(2), number(2));
    if parts.next().is_some() || !matches!(year, Some(Some(_))) {
        return false;
    }
    let is_day = match (month, day_of_month) {
        (None | Some(Some(1..=12)), None) => true,
        (Some(Some(month @ 1..=12)), Some(Some(day))) => (1..=DAYS[month as usize - 1]).contains(&day),
        _ => false,
    };
    is_day && time.is_none_or(|time| day_of_month.is_some() && is_time(time))
}

/// Whether a text is hours and minutes, with or without seconds and their fraction, with or without an offset.
fn is_time(text: &str) -> bool {
    let at = text.find(['Z', '+', '-']).unwrap_or(text.len());
    let (clock, offset) = text.split_at(at);
    let (clock, fraction) =
        clock.split_once(['.', ',']).map_or((clock, None), |(clock, fraction)| (clock, Some(fraction)));
    let parts: Vec<Option<u32>> = if clock.contains(':') {
        clock.split(':').map(|part| number_of(part, 2)).collect()
    } else {
        // What is no text is no number either.
        clock.as_bytes().chunks(2).map(|part| number_of(std::str::from_utf8(part).ok()?, 2)).collect()
    };
    let is_clock = match parts[..] {
        [Some(0..=24), Some(0..=59)] => fraction.is_none(),
        [Some(0..=24), Some(0..=59), Some(0..=60)] => true,
        _ => false,
    };
    let is_fraction = fraction
        .is_none_or(|fraction| !fraction.is_empty() && fraction.bytes().all(|byte| byte.is_ascii_digit()));
    let is_offset = match offset.strip_prefix(['+', '-']) {
        None => offset.is_empty() || offset == "Z",
        Some(offset) => match offset.split_once(':') {
            Some((hours, minutes)) => number_of(hours, 2).is_some() && number_of(minutes, 2).is_some(),
            None => number_of(offset, 2).is_some() || number_of(offset, 4).is_some(),
        },
    };
    is_clock && is_fraction && is_offset
}

/// The number that a text of this many digits is.
pub(super) fn number_of(text: &str, digits: usize) -> Option<u32> {
    let is_number = text.len() == digits && text.bytes().all(|byte| byte.is_ascii_digit());
    if is_number { text.parse().ok() } else { None } // A number of so few digits is in range.
}

#[cfg(test)]
mod tests {
    use super::{DAY_SECS, is_date, iso_date};

    #[test]
    fn days_are_those_of_the_calendar() {
        for (secs, expected) in [
            (0, "1970-01-01"),
            (DAY_SECS - 1, "1970-01-01"),
            (951_782_400, "2000-02-29"),
            (951_868_800, "2000-03-01"),
            (1_709_164_800, "2024-02-29"),
            (1_735_689_599, "2024-12-31"),
            (1_735_689_600, "2025-01-01"),
            (4_107_542_400, "2100-03-01"),
        ] {
            assert_eq!(iso_date(secs), expected);
        }
        // Every day of 400 years follows the one before, and is a date.
        let days: Vec<String> = (0..146_097).map(|day| iso_date(day * DAY_SECS)).collect();
        assert!(days.is_sorted_by(|a, b| a < b) && days.iter().all(|day| is_date(day)));
        assert_eq!(days.last().map(String::as_str), Some("2369-12-31"));
    }

    #[test]
    fn dates_have_some_forms_only() {
        for date in [
            "2026",
            "2026-02",
            "2026-02-28",
            "2026-02-28T09:30",
            "2026-02-28T09:30:15.25Z",
            "2026-02-28T09:30:15+01:00",
            "2026-02-28 09:30:15-0130",
            "20260228",
            "20260228T093015,5Z",
        ] {
            assert!(is_date(date), "{date}");
        }
        for text in [
            "",
            "26",
            "today",
            "2026-13",
            "2026-00-01",
            "2026-04-31",
            "2026-02-28-01",
            "2026-02T09:30",
            "2026-02-28T",
            "2026-02-28T25:00",
            "2026-02-28T09:30:15.",
            "2026-02-28T09:30+1",
            "28.02.2026",
            "20260230",
            "2026022",
            "20260228T0930151",
        ] {
            assert!(!is_date(text), "{text}");
        }
    }
}
