//! Files are made up here.
