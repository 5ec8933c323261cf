//! Figures, drawn by plotters: one function a figure, one style file.
