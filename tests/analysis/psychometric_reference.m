% Maximum-likelihood psychometric functions, written without regard to how analysis/psychometric_fit does it: ln L as a formula of
% the parameters themselves, a penalty for what is out of bounds, the simplex of Nelder and Mead from a lattice of starts.
%
%     octave-cli --no-gui --norc -q psychometric_reference.m < data > fits
%
% Data: a line a set, `sigmoid p gamma largest_delta levels`, then `levels` lines `strength right trials`; sigmoid 1 Weibull, 2
% Gaussian, 3 logistic. Fits: `F T slope delta lnL`.
1;

function s = survival(sigmoid, z)
  if sigmoid == 1, s = exp(-10 .^ z);
  elseif sigmoid == 2, s = erfc(z / sqrt(2)) / 2;
  else s = 1 ./ (1 + exp(z)); end
end

function l = minus_lnl(theta, sigmoid, p, gamma, largest, data)
  t = theta(1); slope = theta(2); delta = theta(3);
  if slope < .05 || slope > 100 || delta < 0 || delta > largest, l = 1e10; return; end
  s = ((1 - p) / (1 - gamma) - delta) / (1 - delta);
  if sigmoid == 1, zp = log10(-log(s));
  elseif sigmoid == 2, zp = sqrt(2) * erfcinv(2 * s);
  else zp = log((1 - s) / s); end
  wrong = (1 - gamma) * (delta + (1 - delta) * survival(sigmoid, slope * (data(:,1) - t) + zp));
  k = data(:,2); n = data(:,3);
  l = -sum(k .* log(1 - wrong)) - sum((n - k) .* log(wrong));
  if !isfinite(l), l = 1e10; end
end

options = optimset('TolX', 1e-10, 'TolFun', 1e-13, 'MaxIter', 4000, 'MaxFunEvals', 8000);
while true
  head = fscanf(stdin, '%f', 5);
  if numel(head) < 5, break; end
  data = fscanf(stdin, '%f', [3 head(5)])';
  f = @(theta) minus_lnl(theta, head(1), head(2), head(3), head(4), data);
  middle = mean(data(:,1));
  best = []; least = inf;
  for slope = [2 6]
    for delta = [.01 .06]
      theta = [middle slope delta];
      for again = 1:2, theta = fminsearch(f, theta, options); end
      if f(theta) < least, least = f(theta); best = theta; end
    end
    % Along the bound, where a simplex gets stuck.
    for delta = [0 head(4)]
      g = @(theta) f([theta delta]);
      theta = [middle slope];
      for again = 1:2, theta = fminsearch(g, theta, options); end
      if g(theta) < least, least = g(theta); best = [theta delta]; end
    end
  end
  printf('F %.15g %.15g %.15g %.15g\n', best, -least);
end
