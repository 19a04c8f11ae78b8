// Arithmetic that decides what a ray hits, and where, with the same bits on every instruction set. Only operations that IEEE 754 rounds
// correctly are used (+, −, ·, /, √). A fused multiply-add would be missing on processors before 2013, and approximate reciprocals differ
// between makers. Fused operations are used only where they select boxes (`intersected_children`, packets).
// Included once per instruction set, hence the guard.
#if defined(ORBC_TRACE_UNFUSED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ORBC_TRACE_UNFUSED_INL_H
#undef ORBC_TRACE_UNFUSED_INL_H
#else
#define ORBC_TRACE_UNFUSED_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace orbc::trace::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
HWY_INLINE V mul_add(V a, V b, V c) {
  return hn::Add(hn::Mul(a, b), c);
}
template <class V>
HWY_INLINE V mul_sub(V a, V b, V c) {
  return hn::Sub(hn::Mul(a, b), c);
}
template <class V>
HWY_INLINE V neg_mul_add(V a, V b, V c) {
  return hn::Sub(c, hn::Mul(a, b));
}

template <class D, std::size_t N>
HWY_INLINE hn::Vec<D> horner(D d, hn::Vec<D> x, const hn::TFromD<D> (&c)[N]) {
  auto sum = hn::Set(d, c[N - 1]);
  for (std::size_t i = N - 1; i-- > 0;) sum = mul_add(sum, x, hn::Set(d, c[i]));
  return sum;
}

/// Coefficients by interpolation at Chebyshev nodes. log: (log((1 + s)/(1 − s)) − 2s)/s³ as a polynomial in s², |s| ≤ tan(π/8)²; relative
/// errors of log 5e-18 and 3e-10. atan: (atan t − t)/t³ in t², |t| ≤ tan(π/8); 7e-18 and 3e-9.
template <class T>
struct Arcs;
template <>
struct Arcs<double> {
  static constexpr double kLog[] = {0.666666666666667,   0.39999999999899444, 0.2857142862600327, 0.22222211130259878,
                                    0.18182889455674947, 0.15331710618210773, 0.14616585424888623};
  static constexpr double kAtan[] = {-0.3333333333333333,   0.19999999999995516, -0.14285714284665682, 0.11111111015187018,
                                     -0.0909090457530649,   0.07692183125376892, -0.06664510525508936, 0.05858140904866328,
                                     -0.050854078345894844, 0.03923044778479309, -0.019175404711104935};
  static constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;  // the high part times any exponent is exact
  static constexpr std::int64_t kRootHalf = 0x3fe6a09e667f3bcd, kMantissa = 0x000fffffffffffff;
  static constexpr int kMantissaBits = 52;
};
template <>
struct Arcs<float> {
  static constexpr float kLog[] = {0.666666687f, 0.400001228f, 0.285508156f, 0.233305827f};
  static constexpr float kAtan[] = {-0.333333313f, 0.199995399f, -0.142639503f, 0.107436687f, -0.0645171851f};
  static constexpr float kLn2High = 0.693359375f, kLn2Low = -2.12194440e-4f;
  static constexpr std::int32_t kRootHalf = 0x3f3504f3, kMantissa = 0x007fffff;
  static constexpr int kMantissaBits = 23;
};

/// log x for normal x > 0; to 2 ulp.
template <class D>
HWY_INLINE hn::Vec<D> log_of(D d, hn::Vec<D> x) {
  using Table = Arcs<hn::TFromD<D>>;
  const hn::RebindToSigned<D> di;
  // Subtracting the bits of √½ makes the exponent field count from [√½, √2).
  const auto bits = hn::Sub(hn::BitCast(di, x), hn::Set(di, Table::kRootHalf));
  const auto k = hn::ConvertTo(d, hn::ShiftRight<Table::kMantissaBits>(bits));
  const auto m = hn::BitCast(d, hn::Add(hn::And(bits, hn::Set(di, Table::kMantissa)), hn::Set(di, Table::kRootHalf)));
  const auto one = hn::Set(d, hn::TFromD<D>(1)), f = hn::Sub(m, one), s = hn::Div(f, hn::Add(m, one)), y = hn::Mul(s, s);
  // log(1 + f) = 2s + s·r = f − s·(f − r), and f is exact.
  const auto small = neg_mul_add(s, hn::Sub(f, hn::Mul(y, horner(d, y, Table::kLog))), hn::Mul(k, hn::Set(d, Table::kLn2Low)));
  return hn::Add(hn::Mul(k, hn::Set(d, Table::kLn2High)), hn::Add(f, small));
}

/// atan2(over, under) for over, under ≥ 0, not both 0; to 2 ulp.
template <class D>
HWY_INLINE hn::Vec<D> arc_in_quadrant(D d, hn::Vec<D> over, hn::Vec<D> under) {
  using T = hn::TFromD<D>;
  const auto small = hn::Min(over, under), big = hn::Max(over, under);
  const auto beyond = hn::Gt(small, hn::Mul(big, hn::Set(d, T(0.41421356237309503))));  // tan(π/8): then from π/4
  const auto t = hn::Div(hn::IfThenElse(beyond, hn::Sub(small, big), small), hn::IfThenElse(beyond, hn::Add(small, big), big));
  const auto y = hn::Mul(t, t), arc = mul_add(hn::Mul(t, y), horner(d, y, Arcs<T>::kAtan), t);
  const auto octant = hn::IfThenElse(beyond, hn::Add(hn::Set(d, T(0.78539816339744828)), arc), arc);
  return hn::IfThenElse(hn::Gt(over, under), hn::Sub(hn::Set(d, T(1.5707963267948966)), octant), octant);
}

/// atan2(over, under) in (−π, π].
template <class D>
HWY_INLINE hn::Vec<D> arc_around(D d, hn::Vec<D> over, hn::Vec<D> under) {
  const auto quadrant = arc_in_quadrant(d, hn::Abs(over), hn::Abs(under));
  const auto half = hn::IfThenElse(hn::Lt(under, hn::Zero(d)), hn::Sub(hn::Set(d, hn::TFromD<D>(3.141592653589793)), quadrant), quadrant);
  return hn::CopySign(half, over);
}

}  // namespace orbc::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
