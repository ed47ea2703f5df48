% Makes psychtoolbox_reference.csv, what Psychtoolbox's Quest says after sequences of trials:
%
%     octave-cli --no-gui --norc -q psychtoolbox_reference.m > psychtoolbox_reference.csv
%
% Made with Octave 7.3.0 and Psychtoolbox 3.0.18 (Debian 12: octave, psychtoolbox-3-common).
%
% A sequence is described by five numbers. From `seed`, s <- 16807 s mod 2^31 - 1 (exact in doubles) gives three numbers
% a, b, c = s/(2^31 - 1) a trial. The intensity is guess + spread (a - 1/2), and 100 times as far from the guess where
% b < 0.05; the response is 1 where c < `above` and the intensity is above the guess, or c < `below` and it is not.
1;

function answer = q_or_nan(f)
  try, answer = f(); catch, answer = NaN; end
end

root = '/usr/share/psychtoolbox-3/';
addpath([root 'PsychBasic'], [root 'PsychProbability'], [root 'Quest']);

% guess, guess_sd, p_threshold, beta, delta, gamma, grain, range (0: none given), seed, trials, spread, above, below
rows = [
  -1   2    .82  3.5 .01 .5  .01  0    1    40  2    .9  .55
  -1   2    .82  3.5 .01 .5  .01  5    2  3000  2    .9  .55
   0   .5   .82  3.5 .01 .5  .01  5    3   300  1    .95 .5
   0   3    .75  1   .05 .25 .02  10   4  1000  3    .8  .3
  50   50   .82  3.5 .01 .5  .1   100  5    60  80   .95 .5
   2.3 1    .5   2   .02 0   .05  4.2  6   200  1.5  .8  .2
   0   1    .795 3.5 0   0   .1   5    7    10  .2   1   0
  -.37 .8   .6   10  .01 .5  .001 1    8   100  .3   .9  .6
   0   1e9  .82  3.5 .01 .5  .01  2    9    10  1e6  .5  .5
   0   1e-6 .82  3.5 .01 .5  .01  5   10    50  2    .9  .55
   1   .3   .82  3.5 .01 .9  .01  5   11    80  1    .9  .55
   0   2    .82  .7  .1  .5  .07  9   12  2000  4    .8  .6
   0   .05  .9   5   .03 .5  .01  3   13   500  .4   .6  .9
   0   1    .82  3.5 .01 .5  .01  5   14   700  .02  .02 .02
   0   1    .3   3   .2  .1  .03  0   15   150  6    .7  .2
];
printf(['guess,guess_sd,p_threshold,beta,delta,gamma,grain,range,seed,trials,spread,above,below,' ...
        'mean,mode,quantile,sd,low,high,quantile_order,x_threshold\n']);
for r = 1:size(rows, 1)
  p = rows(r, :);
  if p(8) == 0
    q = QuestCreate(p(1), p(2), p(3), p(4), p(5), p(6), p(7));
  else
    q = QuestCreate(p(1), p(2), p(3), p(4), p(5), p(6), p(7), p(8));
  end
  q.normalizePdf = 1;
  q.warnPdf = 0;
  s = p(9);
  m = 2147483647;
  for trial = 1:p(10)
    s = mod(16807 * s, m); a = s / m;
    s = mod(16807 * s, m); b = s / m;
    s = mod(16807 * s, m); c = s / m;
    distance = p(11) * (a - .5);
    if b < .05, distance = 100 * distance; end
    intensity = p(1) + distance;
    if intensity > p(1), share = p(12); else, share = p(13); end
    q = QuestUpdate(q, intensity, c < share);
  end
  printf('%.17g,', p);
  printf('%.17g,', QuestMean(q), QuestMode(q), q_or_nan(@() QuestQuantile(q)), real(QuestSd(q)), ...
         q_or_nan(@() QuestQuantile(q, .025)), q_or_nan(@() QuestQuantile(q, .975)), q.quantileOrder);
  printf('%.17g\n', q.xThreshold);
end
exit(0);
