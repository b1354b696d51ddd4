% SPDX-License-Identifier: BSD-3-Clause
%
% The identification of chapter 6 (12 links, four unknowns) the way it was done: the generic algorithms,
% sums over links, with ode15s and fminsearch. Run by scripts/compare_octave, in a folder that has
%   start.csv   the 12 angles at the start, and on a second line how many evaluations fminsearch may take
%   truth.csv   time, then side and down of the 12 joints, one line a time
% Prints, one a line: the mean distance at the start parameters (m); the evaluations of it in all; seconds an
% evaluation; seconds a call of the accelerations by matrices, and by loops over links.
1;

% The accelerations with every sum over links written as a matrix, which is Octave's fast way.
function ydot = rates(y, p)
  n = p.n;
  theta = y(1:n);
  omega = y(n+1:2*n);
  side = cos(theta);
  down = sin(theta);
  difference = theta - theta';
  M = p.coupling .* cos(difference);
  h = (p.coupling .* sin(difference)) * omega.^2 + p.weight .* down;
  moment = p.k .* diff([0; theta]) + p.c .* diff([0; omega]);
  h += moment - [moment(2:n); 0];
  u = p.reach * (omega .* side);                    % the links' middles, and air drag on them
  w = -p.reach * (omega .* down);
  force = p.drag * p.length * sqrt(u.^2 + w.^2 + 1e-12);
  h += side .* (p.reach' * (force .* u)) - down .* (p.reach' * (force .* w));
  ydot = [omega; -(M \ h)];
end

% The same as the loops a textbook writes.
function ydot = rates_by_loops(y, p)
  n = p.n;
  theta = y(1:n);
  omega = y(n+1:2*n);
  M = zeros(n, n);
  h = zeros(n, 1);
  for i = 1:n
    for j = 1:n
      beyond = p.load + p.mass * (n - max(i, j));   % mass beyond the outer of the two links
      if i == j
        M(i, i) = p.inertia + p.length^2 * (p.mass / 4 + beyond);
      else
        coupling = p.length^2 * (p.mass / 2 + beyond);
        M(i, j) = coupling * cos(theta(i) - theta(j));
        h(i) = h(i) + coupling * sin(theta(i) - theta(j)) * omega(j)^2;
      end
    end
    h(i) = h(i) + p.gravity * p.length * (p.mass / 2 + p.load + p.mass * (n - i)) * sin(theta(i));
  end
  for i = 1:n                                       % joints
    if i == 1
      moment = p.k(1) * theta(1) + p.c(1) * omega(1);
    else
      moment = p.k(i) * (theta(i) - theta(i-1)) + p.c(i) * (omega(i) - omega(i-1));
      h(i-1) = h(i-1) - moment;
    end
    h(i) = h(i) + moment;
  end
  for k = 1:n                                       % air drag at the link's middle
    side = 0; down = 0;
    for j = 1:k
      reach = p.length * (1 - (j == k) / 2);
      side = side + reach * omega(j) * cos(theta(j));
      down = down - reach * omega(j) * sin(theta(j));
    end
    force = p.drag * p.length * sqrt(side^2 + down^2 + 1e-12);
    for j = 1:k
      reach = p.length * (1 - (j == k) / 2);
      h(j) = h(j) + reach * force * (side * cos(theta(j)) - down * sin(theta(j)));
    end
  end
  ydot = [omega; -(M \ h)];
end

function p = with(p, x)                             % the unknowns: damping and stiffness, joint 1 apart
  x = exp(x);
  p.c = [x(1); repmat(x(3), p.n - 1, 1)];
  p.k = [x(2); repmat(x(4), p.n - 1, 1)];
end

function distance = mean_distance(x, p, start, truth)
  p = with(p, x);
  y = [start; zeros(p.n, 1)];                       % at rest; ode15s asks for the slope there too
  options = odeset("RelTol", 1e-6, "AbsTol", 1e-8, "InitialSlope", rates(y, p));
  [~, y] = ode15s(@(t, y) rates(y, p), truth(:, 1), y, options);
  theta = y(:, 1:p.n);
  side = cumsum(p.length * sin(theta), 2);
  down = cumsum(p.length * cos(theta), 2);
  distance = mean(mean(sqrt((side - truth(:, 2:2:end)).^2 + (down - truth(:, 3:2:end)).^2)));
end

function seconds = price(call)                      % CPU time of one call
  begin = cputime;
  for i = 1:300
    call();
  end
  seconds = (cputime - begin) / 300;
end

given = dlmread("start.csv", ",");
start = given(1, 1:12)';
truth = dlmread("truth.csv", ",");
p.n = 12;
p.length = 3.39 / p.n;
p.mass = 0.1424 * p.length;
p.inertia = p.mass * p.length^2 / 12;
p.load = 1.47;
p.gravity = 9.81;
p.drag = 0.2;
outer = max((1:p.n)', 1:p.n);
p.coupling = p.length^2 * (p.mass / 2 + p.load + p.mass * (p.n - outer));
p.coupling(1:p.n+1:end) += p.inertia - p.length^2 * p.mass / 4;
p.weight = p.gravity * p.length * (p.mass / 2 + p.load + p.mass * (p.n - (1:p.n)'));
p.reach = p.length * (tril(ones(p.n)) - eye(p.n) / 2);
x = log([2.688e-4, 47.448, 1.344e-4, 47.448]);

y = [start; 3 * sin((1:p.n)')];
assert(rates_by_loops(y, with(p, x)), rates(y, with(p, x)), -1e-9);
begin = cputime;
at_start = mean_distance(x, p, start, truth);
evaluations = 1;
if given(2, 1) > 0
  options = optimset("MaxFunEvals", given(2, 1), "Display", "off");
  % from zero, so that its simplex is of size one: in logarithms, a factor e
  [~, ~, ~, output] = fminsearch(@(d) mean_distance(x + d, p, start, truth), 0 * x, options);
  evaluations += output.funcCount;
end
seconds = (cputime - begin) / evaluations;
p = with(p, x);
printf("%.17g\n%d\n%.17g\n%.17g\n%.17g\n", at_start, evaluations, seconds, ...
       price(@() rates(y, p)), price(@() rates_by_loops(y, p)));
