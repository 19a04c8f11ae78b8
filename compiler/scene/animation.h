#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compiler/scene/document.h"
#include "compiler/scene/scene.h"

namespace orbc::scene {

/// How a value runs between two keyframes: at constant speed, slowly at both ends, or not at all until the next keyframe.
enum class Interpolation { linear, smooth, step };

struct Keyframe {
  double t = 0;  ///< moment, 0…1
  Node value;
};
/// A value that is given at some moments; before the first and after the last it stays.
struct Keyframes {
  std::vector<Keyframe> keys;  ///< in ascending order of t; at least one
  Interpolation interpolation = Interpolation::linear;
};

/// Once around the room at a constant distance from the walls, from corner to corner, counter-clockwise, at constant speed.
struct WallWalk {
  double distance = 0.15;   ///< from the wall that is walked along
  int start = 1;            ///< corner at which it begins (from 1)
  int laps = 1;             ///< in the whole film; negative: clockwise
  std::optional<double> z;  ///< height of what walks
};

/// A closed curve through places, smooth at them, at constant speed.
struct PlacePath {
  std::vector<Place> places;  ///< at least three
};

/// The direction in which the thing itself moves: towards the point that lies `lead` ahead on its path.
struct Ahead {
  double lead = 0.2;  ///< arc length
  Angle offset;       ///< added to the direction, counter-clockwise
  Angle elevation;    ///< of a gaze
};

/// How one value of the scene moves.
struct Track {
  std::string path;  ///< of the value, as in --set: `camera.fov`, `objects.statue.at`
  std::variant<Keyframes, WallWalk, PlacePath, Ahead> motion;
  SourceSpan path_span, span;
};

/// A film of a scene. Frame i of n shows the moment t = i/n, so that a closed motion has no frame twice.
struct Animation {
  int frames = 100;
  double rate = 25;          ///< frames per second
  bool fixed_noise = false;  ///< random numbers are the same in each frame (key `seed: locked`)
  std::vector<Track> tracks;
  SourceSpan span;
};

}  // namespace orbc::scene
