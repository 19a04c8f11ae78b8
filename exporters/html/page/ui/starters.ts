/** The rooms of the empty page, with pictures of them, which scripts/gallery traces. */
import euclidean from '../starters/euclidean.yaml';
import euclideanPicture from '../starters/euclidean.jpg';
import hyperbolic from '../starters/hyperbolic.yaml';
import hyperbolicPicture from '../starters/hyperbolic.jpg';
import spherical from '../starters/spherical.yaml';
import sphericalPicture from '../starters/spherical.jpg';

export const examples = [
  { notation: '*222', space: 'spherical', where: 'S²×R', chi: '¼', line: 'Three right angles. Eight rooms are the whole sphere.', text: spherical, picture: sphericalPicture },
  { notation: '*333', space: 'euclidean', where: 'E²×R', chi: '0', line: 'Three angles of 60°. Six rooms meet at each corner.', text: euclidean, picture: euclideanPicture },
  { notation: '*22222', space: 'hyperbolic', where: 'H²×R', chi: '−¼', line: 'Five right angles. No flat pentagon has them.', text: hyperbolic, picture: hyperbolicPicture },
] as const;
