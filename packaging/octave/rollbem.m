% Rolling contact with friction: the results of the program rollbem as a struct.
%
%   s = rollbem ("mu", 0.3, "creep", 0.1)            one case
%   c = rollbem ("curve", "load", 500, "support", "halfplane")
%   t = rollbem ("stress", "rail.ini", "grid", "61x41")
%   p = rollbem ("lcp", "problem.txt", "solution", true)
%
% A command and a case file come first, if any, then options by name, with _ or - : numbers,
% text, true for a flag.  The fields are those of the program's JSON: s.summary.max_pressure,
% s.table.p_MPa.  What is refused is an error in the program's words; a run that ends without
% a full answer is a warning, and s holds what there is.  The program is ROLLBEM of the
% environment, or the rollbem of the path.
function result = rollbem (varargin)
  program = getenv ("ROLLBEM");
  if (isempty (program))
    program = "rollbem";
  endif
  commands = {"curve", "stress", "lcp", "friction", "compare", "example"};
  words = {program};
  if (nargin > 0 && any (strcmp (varargin{1}, commands)))
    words(end+1) = varargin(1);
    varargin(1) = [];
  endif
  if (mod (numel (varargin), 2) == 1)
    words(end+1) = varargin(1);
    varargin(1) = [];
  endif
  for k = 1:2:numel (varargin)
    words{end+1} = as_option (varargin{k:k+1});
  endfor
  words{end+1} = "--json";

  messages = tempname ();
  [status, text] = system ([strjoin(cellfun (@quoted, words, "UniformOutput", false)) ...
                            " 2>" quoted(messages)]);
  said = strtrim (fileread (messages));
  unlink (messages);
  lines = strsplit (said, "\n");
  lines = lines(strncmp (lines, "rollbem: ", 9) & ! strncmp (lines, "rollbem: note", 13));
  if (isempty (text) && status != 0)
    error ("rollbem:refused", "%s", strjoin ([lines, {said}](1), "\n"));
  endif
  if (status != 0)
    warning ("rollbem:unsolved", "%s", strjoin (lines, "\n"));
  endif
  result = jsondecode (text);
endfunction

function word = as_option (name, value)
  name = ["--" strrep(name, "_", "-")];
  if (islogical (value))
    word = {[name "=no"], [name "=yes"]}{value + 1};
  elseif (ischar (value))
    word = [name "=" value];
  else
    word = [name "=" strjoin(arrayfun (@(x) sprintf ("%.17g", x), value(:).', ...
                                       "UniformOutput", false), ",")];
  endif
endfunction

function text = quoted (word)
  text = ["'" strrep(word, "'", "'\\''") "'"];
endfunction
