% Computes again, from the mesh alone, what `rollbem --dump` wrote: H and G by quadrature,
% the flexibility F, the LCP of the paper, and every tableau of Lemke's method.
% Prints the page; ends with code 1 where anything differs.
1;

function A = read_mtx(folder, name)
  file = fopen(fullfile(folder, [name '.mtx']));
  line = fgetl(file);
  while line(1) == '%'
    line = fgetl(file);
  end
  shape = sscanf(line, '%d');
  A = reshape(fscanf(file, '%f'), shape');
  fclose(file);
end

% Nodes and weights of Gauss on [-1, 1] (Golub and Welsch).
function [x, w] = gauss(n)
  k = 1:n-1;
  b = k ./ sqrt(4 * k.^2 - 1);
  [V, D] = eig(diag(b, 1) + diag(b, -1));
  x = diag(D)';
  w = 2 * V(1, :).^2;
end

% (B2) Kelvin: displacement and traction kernels at r = (rx, ry), outward normal n.
% The logarithm's unit of length r0 is free (a rigid motion); the program takes the
% diagonal of the square around a circle as long as the contour.
function [U, T] = kelvin(rx, ry, n, shear, nu, r0)
  r2 = rx^2 + ry^2;
  r = sqrt(r2);
  d = [rx; ry] / r;
  dn = d' * n;
  U = (-(3 - 4*nu) * log(r/r0) * eye(2) + d * d') / (8*pi*shear*(1 - nu));
  T = -(dn * ((1 - 2*nu) * eye(2) + 2 * d * d') ...
        - (1 - 2*nu) * (d * n' - n * d')) / (4*pi*(1 - nu)*r);
end

% (B1) H u = G t, constant elements collocated at their midpoints.
function [H, G] = influence(mesh, shear, nu)
  n = rows(mesh);
  H = zeros(2*n);
  G = zeros(2*n);
  [s, w] = gauss(60);
  C = 1 / (8*pi*shear*(1 - nu));
  r0 = sqrt(2)/pi * sum(hypot(mesh(:, 3) - mesh(:, 1), mesh(:, 4) - mesh(:, 2)));
  for j = 1:n
    m = (mesh(j, 1:2) + mesh(j, 3:4))' / 2;
    h = (mesh(j, 3:4) - mesh(j, 1:2))' / 2;
    a = norm(h);
    t = h / a;
    normal = [t(2); -t(1)];
    for i = 1:n
      p = (mesh(i, 1:2) + mesh(i, 3:4))' / 2;
      Hij = zeros(2);
      Gij = zeros(2);
      if i == j   % int ln|s/r0| ds = 2a (ln(a/r0) - 1); r,i r,j = t t'; free term 1/2
        Hij = eye(2) / 2;
        Gij = C * (-(3 - 4*nu) * 2*a * (log(a/r0) - 1) * eye(2) + 2*a * t * t');
      else
        for k = 1:numel(s)
          r = m + s(k) * h - p;
          [U, T] = kelvin(r(1), r(2), normal, shear, nu, r0);
          Hij += a * w(k) * T;
          Gij += a * w(k) * U;
        end
      end
      H(2*i-1:2*i, 2*j-1:2*j) = Hij;
      G(2*i-1:2*i, 2*j-1:2*j) = Gij;
    end
  end
end

% (B4), (B5) displacements w = F r of the contact elements and the one after them.
function F = flexibility(mesh, H, G)
  n = rows(mesh);
  condition = reshape(mesh(:, 5:6)', 2*n, 1);   % 0 traction, 1 displacement, 2 contact
  A = H;
  A(:, condition == 1) = -G(:, condition == 1); % there the traction is the unknown
  c = find(mesh(:, 5) == 2)';
  nc = numel(c);
  x = [2*c, 2*c - 1];           % r_N is t_y, r_T is t_x (section 2: n = +y, t = +x)
  X = A \ G(:, x);
  kept = [c, c(end) + 1];
  F = X([2*kept, 2*kept - 1], :);
end

% (K4) the LCP of the paper: z = (r_N, lambda+_1, lambda-_1, lambda+_2, ...).
function [M, b] = kwak(F, gap, approach, shift, mu)
  nc = columns(F) / 2;
  m = rows(F) / 2;
  FNN = F(1:nc, 1:nc);
  FNT = F(1:nc, nc+1:end);
  FTN = F(m+1:m+nc, 1:nc);
  FTT = F(m+1:m+nc, nc+1:end);
  TT = kron(eye(nc), [1 -1]);
  TN = kron(eye(nc), [mu mu]);
  dN = gap - approach;
  dT = shift * ones(nc, 1);
  B = inv(FTT);
  M = [FNN - FNT*B*FTN, FNT*B*TT; TN' - TT'*B*FTN, TT'*B*TT];
  b = [dN - FNT*B*dT; -TT'*B*dT];
end

function names = variables(nc)
  names = {};
  for k = 1:nc, names{end+1} = sprintf('gap[%d]', k); end
  for k = 1:nc, names{end+1} = sprintf('gamma+[%d]', k); names{end+1} = sprintf('gamma-[%d]', k); end
  for k = 1:nc, names{end+1} = sprintf('p[%d]', k); end
  for k = 1:nc, names{end+1} = sprintf('lambda+[%d]', k); names{end+1} = sprintf('lambda-[%d]', k); end
  names{end+1} = 'z0';
end

function [row, column] = read_basis(folder, k, names)
  file = fopen(fullfile(folder, sprintf('basis_%d.txt', k)));
  words = {strsplit(fgetl(file), ' '), strsplit(fgetl(file), ' ')};
  fclose(file);
  row = cellfun(@(s) find(strcmp(s, names)), words{1}(2:end));
  column = cellfun(@(s) find(strcmp(s, names)), words{2}(2:end));
end

% w - M z - z0 = b solved for the basic variables.
function T = tableau(M, b, row, column)
  n = rows(M);
  E = [eye(n), -M, -ones(n, 1)];
  T = [-(E(:, row) \ E(:, column)), E(:, row) \ b];
end

function compare(what, got, wanted, bound)
  global wrong;
  scale = max(abs(wanted(:)));
  e = max(abs(got(:) - wanted(:))) / scale;
  if e <= bound, verdict = 'agrees'; else, verdict = 'DIFFERS'; wrong = true; end
  printf('%s: %s with the program, difference below %.0e\n', what, verdict, bound);
  if e > bound, fprintf(stderr, '%s: difference %g\n', what, e); end
end

% Nothing is shown as -0.000.
function A = tidy(A)
  A(abs(A) < 5e-8) = 0;
end

function show(A, format)
  A = tidy(A);
  for i = 1:rows(A)
    printf(format, A(i, :));
    printf('\n');
  end
  printf('\n');
end

global wrong = false;
folder = argv(){end};
young = 94500; nu = 0.1; mu = 0.2; approach = 5; shift = 0.5;   % case.ini
shear = young / (2*(1 + nu));
mesh = read_mtx(folder, 'mesh');
contact = read_mtx(folder, 'contact');
nc = rows(contact);

printf('Boundary elements: x0, y0, x1, y1 [mm], condition in x and y (0 traction given, 1 displacement given, 2 contact)\n');
show(mesh, '%10.4f');

[H, G] = influence(mesh, shear, nu);
compare('H', H, read_mtx(folder, 'H'), 1e-11);
show(H, '%7.3f');
compare('G', G, read_mtx(folder, 'G'), 1e-11);
printf('G times 1e5 [mm/MPa]\n');
show(1e5 * G, '%7.2f');

F = flexibility(mesh, H, G);
compare('F', F, read_mtx(folder, 'F'), 1e-10);
printf('F times 1e5 [mm/MPa]: w_N of the four contact elements and the one after them, then w_T; r_N, then r_T\n');
show(1e5 * F, '%9.4f');

[M, b] = kwak(F, contact(:, 3), approach, shift, mu);
z_scale = read_mtx(folder, 'z_scale');
w_scale = read_mtx(folder, 'w_scale');
M = diag(1 ./ w_scale) * M * diag(z_scale);
b = b ./ w_scale;
compare('M', M, read_mtx(folder, 'M'), 1e-10);
printf('M, scaled: z = (p, lambda+, lambda-), w = (gap, gamma+, gamma-), the last two element by element\n');
show(M, '%9.4f');
compare('b', b, read_mtx(folder, 'b'), 1e-10);
show(b', '%9.4f');

names = variables(nc);
pivots = numel(glob(fullfile(folder, 'tableau_*.mtx')));
[row, column] = deal(1:3*nc, 3*nc+1:6*nc+1);
for k = 1:pivots
  [new_row, column] = read_basis(folder, k, names);
  changed = find(new_row != row);
  T = tableau(M, b, new_row, column);
  printf('Pivot %d: %s enters, %s leaves. ', k, names{new_row(changed)}, names{row(changed)});
  compare('Tableau', T, read_mtx(folder, sprintf('tableau_%d', k)), 1e-9);
  if any(T(:, end) < -1e-12)
    wrong = true;
    printf('a basic variable is negative\n');
  end
  printf('%10s', ''); printf('%11s', names{column}); printf('%11s\n', 'value');
  for i = 1:rows(T)
    printf('%10s', names{new_row(i)}); printf('%11.4f', tidy(T(i, :))); printf('\n');
  end
  printf('\n');
  row = new_row;
end

% The last tableau holds the solution; put it into M z + b.
z = zeros(3*nc, 1);
basic = row > 3*nc & row <= 6*nc;
z(row(basic) - 3*nc) = T(basic, end);
residual = max(abs(min(z, M*z + b)));
compare('Complementarity', 1 + residual, 1, 1e-12);
printf('p [MPa]:'); printf('%12.3f', z(1:nc) .* z_scale(1:nc)); printf('\n');
if wrong
  exit(1);
end
