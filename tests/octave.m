% The results in Octave are the program's; jsondecode may miss the last bit of a number.
function verdict (name, test)
  try
    test ();
    printf ("[       OK ] %s\n", name);
  catch failure
    printf ("[  FAILED  ] %s: %s\n", name, failure.message);
  end_try_catch
endfunction

function same_numbers ()
  s = rollbem ("mu", 0.3, "creep", 0.1);
  [~, text] = system ([getenv("ROLLBEM") " --mu 0.3 --creep 0.1 --header=bare 2>/dev/null"]);
  rows = strsplit (strtrim (text), "\n");
  table = cell2mat (cellfun (@(row) sscanf (row, "%f").', rows(2:end).', "UniformOutput", false));
  assert (s.table.p_MPa, table(:, 4), -2 * eps);
  assert (s.table.q_MPa, table(:, 5), -2 * eps);
  assert (sum (s.table.p_MPa .* s.table.h_mm), s.summary.normal_load, 1e-12 * s.summary.normal_load);
endfunction

function commands_and_flags ()
  c = rollbem ("curve", "load", 500, "support", "halfplane", "similar", true, "points", 5);
  assert (c.curve.force_ratio(end), -1, 1e-9);
  s = rollbem ("examples/hertz/case.ini", "contact_elements", 20);
  assert (numel (s.table.x_mm) >= 20);
endfunction

function refusals ()
  try
    rollbem ("mu", -1);
    error ("nothing was refused");
  catch refusal
    assert (refusal.identifier, "rollbem:refused");
    assert (refusal.message, "rollbem: --mu: expected a number >= 0, got '-1'");
  end_try_catch

  warning ("off", "rollbem:unsolved");
  s = rollbem ("zone", 1);
  assert (s.summary.status, "potential contact too small");
endfunction

verdict ("same_numbers", @same_numbers);
verdict ("commands_and_flags", @commands_and_flags);
verdict ("refusals", @refusals);
