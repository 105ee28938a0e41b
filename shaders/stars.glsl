// A star is about a pixel in size, so that it neither flickers nor grows. Its light at a distance from its middle is
// exp(-starFall d^2), with d in pixels.
const float starFall = 1.4;
